# More tasks than the paper's two: does telling the task in one way or another still work? No other result
# needs it, so it has a target of its own: `snakemake many_tasks`. Only the catalogue's objects, whose parts have roles.


use rule map_contacts as map_further_contacts with:
    output:
        contact_map="data/many_tasks/contact_maps/{object}/{task}.npz",
    wildcard_constraints:
        task=FURTHER,


use rule synthesize_grasps as synthesize_further_grasps with:
    input:
        distance_grid=rules.prepare_object.output.distance_grid,
        collision=rules.prepare_object.output.collision,
        properties=rules.prepare_object.output.properties,
        surface=rules.prepare_object.output.surface,
        contact_map=rules.map_further_contacts.output.contact_map,
    output:
        grasps="data/many_tasks/grasps/{object}/{task}.parquet",
        attempts="data/many_tasks/attempts/{object}/{task}.parquet",
    wildcard_constraints:
        task=FURTHER,


use rule label_grasps as label_many_grasps with:
    input:
        grasps=many_grasps,
        grids=expand(rules.prepare_object.output.distance_grid, object=config["objects"]["names"]),
    output:
        grasps="data/many_tasks/grasps.csv",
        samples="data/many_tasks/samples.csv",
    params:
        least=config["many_tasks"]["least_grasps"],


rule extract_shifted_features:
    input:
        pictures=rules.render_object.output.pictures,
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/many_tasks/features/{object}.npz",
    params:
        shifts=lambda wildcards: {
            task: shift
            for task, shift in many_shifts().items()
            if task in further_tasks(wildcards.object)
        },
        views=config["many_tasks"]["views"],
        settings=settings("features"),
        code=script_hash("extract_shifted_features"),
    message:
        "Extracting features of {wildcards.object} with the colours of more tasks"
    script:
        "../scripts/extract_shifted_features.py"


use rule demonstrate_tasks as demonstrate_further_tasks with:
    input:
        visual=rules.prepare_object.output.visual,
        surface=rules.prepare_object.output.surface,
        grasps=lambda wildcards: expand(
            rules.synthesize_further_grasps.output.grasps,
            object=wildcards.object,
            task=further_tasks(wildcards.object),
        ),
    output:
        pictures="data/many_tasks/demonstrations/{object}.zip",
    params:
        tasks=lambda wildcards: further_tasks(wildcards.object),
    message:
        "Showing {wildcards.object} at more tasks"


use rule describe_demonstrations as describe_further_demonstrations with:
    input:
        pictures=rules.demonstrate_further_tasks.output.pictures,
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/many_tasks/demonstrations/features/{object}.npz",
    message:
        "Extracting features of {wildcards.object} at more tasks"


use rule plot_demonstrations as plot_further_demonstrations with:
    input:
        pictures=further(rules.demonstrate_further_tasks.output.pictures),
    output:
        sheet="reports/figures/further_demonstrations.png",
    params:
        objects=further_objects,
    message:
        "Laying out the sheet of more tasks"


rule learn_many_tasks:
    input:
        inputs=expand(rules.extract_features.output.features, object=config["objects"]["names"]),
        shifted=lambda wildcards: (
            further(rules.extract_shifted_features.output.features)(wildcards)
            if wildcards.told == "task_in_image"
            else []
        ),
        demonstrations=lambda wildcards: (
            expand(rules.describe_demonstrations.output.features, object=DEMONSTRATED)
            if wildcards.told == "demonstration"
            else []
        ),
        further_demonstrations=lambda wildcards: (
            further(rules.describe_further_demonstrations.output.features)(wildcards)
            if wildcards.told == "demonstration"
            else []
        ),
        samples=rules.label_many_grasps.output.samples,
        folds=rules.split_folds.output.folds,
    output:
        metrics="data/many_tasks/metrics/{told}.csv",
    wildcard_constraints:
        told="|".join(TOLD),
    params:
        settings=config["many_tasks"],
        further=lambda wildcards: {name: further_tasks(name) for name in further_objects()},
        predictors=settings("predictors"),
        missing=config["demonstrations"]["missing"],
        tasks=hashes([TASKS_FILE]),
        seed=config["seed"],
        code=script_hash("learn_many_tasks"),
    message:
        "Testing {wildcards.told} with many tasks"
    script:
        "../scripts/learn_many_tasks.py"


rule tabulate_many_tasks:
    input:
        metrics=expand(rules.learn_many_tasks.output.metrics, told=TOLD),
        samples=rules.label_many_grasps.output.samples,
    output:
        table=report(
            "reports/many_tasks.csv",
            caption="../report/many_tasks.rst",
            category="Results",
            labels={"subject": "many tasks", "labels": "simulated", "kind": "table"},
        ),
        markdown="reports/many_tasks.md",
        figure=report(
            "reports/figures/many_tasks.png",
            caption="../report/many_tasks.rst",
            category="Results",
            labels={"subject": "many tasks", "labels": "simulated", "kind": "figure"},
        ),
    params:
        tasks=MANY,
        code=script_hash("tabulate_many_tasks"),
    message:
        "Tabulating the models with many tasks"
    script:
        "../scripts/tabulate_many_tasks.py"


rule publish_many_tasks:
    input:
        trials=rules.tabulate_many_tasks.input.metrics,
        samples=rules.label_many_grasps.output.samples,
        backbone=rules.prepare_backbone.output.record,
    output:
        runs="reports/many_task_runs.json",
    params:
        settings=settings("predictors") | {"many_tasks": config["many_tasks"]},
        tracking=settings("tracking"),
        hand=Path(config["hand"]).name,
        code=script_hash("publish_many_tasks"),
    message:
        "Publishing the models with many tasks to MLflow"
    script:
        "../scripts/publish_many_tasks.py"


rule many_tasks:
    input:
        rules.tabulate_many_tasks.output,
        rules.plot_further_demonstrations.output,
        rules.publish_many_tasks.output,
    message:
        "Models tested with many tasks, and published"
