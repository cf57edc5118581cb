# Model (f): the task is told by a second image, of another object at work. No other result needs it,
# so it has a target of its own: `snakemake demonstrations`.
from grasptypes.settings.demonstrations import DEMONSTRATIONS, read_demonstrations

# Those that the table says how to use.
DEMONSTRATED = [name for name in OBJECTS if name in read_demonstrations().uses]
DEMONSTRATORS = {
    labels: [name for name in KNOWN[labels].objects if name in DEMONSTRATED] for labels in LABELS
}


rule demonstrate_tasks:
    input:
        visual=rules.prepare_object.output.visual,
        surface=rules.prepare_object.output.surface,
        grasps=expand("data/grasps/{{object}}/{task}.parquet", task=["handoff", "use"]),
    output:
        pictures="data/demonstrations/{object}.zip",
    params:
        tasks=["handoff", "use"],
        alone=False,
        hand=hand_parameter(config["hand"]),
        settings=settings("demonstrations", "missing", "sheet"),
        renders=settings("renders", "views", "sheet") | {"shadow_strength": 0.0},
        table=hashes([str(DEMONSTRATIONS)]),
        seed=config["seed"],
        code=script_hash("demonstrate_tasks"),
    message:
        "Showing {wildcards.object} at work"
    script:
        "../scripts/demonstrate_tasks.py"


use rule extract_features as describe_demonstrations with:
    input:
        pictures=rules.demonstrate_tasks.output.pictures,
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/demonstrations/features/{object}.npz",
    params:
        settings=settings("features"),
        tasks={},
        code=script_hash("extract_features"),
    message:
        "Extracting features of {wildcards.object} at work"


use rule plot_renders as plot_demonstrations with:
    input:
        pictures=expand(rules.demonstrate_tasks.output.pictures, object=DEMONSTRATED),
    output:
        sheet=report(
            "reports/figures/demonstrations.png",
            caption="../report/demonstrations.rst",
            category="Objects",
            labels={"subject": "demonstrations", "kind": "figure"},
        ),
    params:
        objects=DEMONSTRATED,
        sheet=config["demonstrations"]["sheet"],
        compression=config["renders"]["png_compression"],
        code=script_hash("plot_renders"),
    message:
        "Laying out the sheet of demonstrations"


rule learn_from_demonstrations:
    input:
        inputs=lambda wildcards: expand(
            rules.extract_features.output.features, object=DEMONSTRATORS[wildcards.labels]
        ),
        demonstrations=lambda wildcards: expand(
            rules.describe_demonstrations.output.features,
            object=DEMONSTRATORS[wildcards.labels],
        ),
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics="data/demonstrations/metrics/{labels}.csv",
    params:
        model="demonstration",
        settings=settings("predictors"),
        missing=config["demonstrations"]["missing"],
        table=hashes([str(DEMONSTRATIONS)]),
        seed=config["seed"],
        code=script_hash("learn_from_demonstrations"),
    message:
        "Testing the model that is shown the task ({wildcards.labels} labels)"
    script:
        "../scripts/learn_from_demonstrations.py"


rule tabulate_demonstrations:
    input:
        trials=expand(rules.learn_from_demonstrations.output.metrics, labels=LABELS),
        others=expand(
            rules.train_predictor.output.metrics,
            labels=LABELS,
            model=["no_task", "task_vector", "task_in_image"],
        ),
    output:
        table=report(
            "reports/demonstrations.csv",
            caption="../report/demonstrations.rst",
            category="Results",
            labels={"subject": "demonstrations", "labels": "both", "kind": "table"},
        ),
        markdown="reports/demonstrations.md",
    params:
        code=script_hash("tabulate_demonstrations"),
    message:
        "Tabulating the model that is shown the task"
    script:
        "../scripts/tabulate_demonstrations.py"


# A control: the grasp alone, without the second hand or what the object acts on. Simulated labels hardly depend on the
# task.
CONTROLLED = [labels for labels in LABELS if labels == "published"] or LABELS


use rule demonstrate_tasks as demonstrate_grasps_alone with:
    output:
        pictures="data/demonstrations/alone/{object}.zip",
    params:
        alone=True,
    message:
        "Showing {wildcards.object} in a hand"


use rule describe_demonstrations as describe_grasps_alone with:
    input:
        pictures=rules.demonstrate_grasps_alone.output.pictures,
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/demonstrations/alone/features/{object}.npz",
    message:
        "Extracting features of {wildcards.object} in a hand"


use rule plot_demonstrations as plot_grasps_alone with:
    input:
        pictures=expand(rules.demonstrate_grasps_alone.output.pictures, object=DEMONSTRATED),
    output:
        sheet="reports/figures/grasps_alone.png",
    message:
        "Laying out the sheet of grasps alone"


use rule learn_from_demonstrations as learn_from_grasps_alone with:
    input:
        inputs=lambda wildcards: expand(
            rules.extract_features.output.features, object=DEMONSTRATORS[wildcards.labels]
        ),
        demonstrations=lambda wildcards: expand(
            rules.describe_grasps_alone.output.features, object=DEMONSTRATORS[wildcards.labels]
        ),
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics="data/demonstrations/alone/metrics/{labels}.csv",
    params:
        model="grasp_alone",
    message:
        "Testing the model that is shown a grasp ({wildcards.labels} labels)"


use rule tabulate_demonstrations as tabulate_grasps_alone with:
    input:
        trials=expand(rules.learn_from_grasps_alone.output.metrics, labels=CONTROLLED),
        others=expand(
            rules.train_predictor.output.metrics,
            labels=CONTROLLED,
            model=["no_task", "task_vector", "task_in_image"],
        ),
    output:
        table="reports/demonstrations_alone.csv",
        markdown="reports/demonstrations_alone.md",
    message:
        "Tabulating the model that is shown a grasp"


rule publish_demonstrations:
    input:
        trials=[
            *rules.tabulate_demonstrations.input.trials,
            *rules.tabulate_grasps_alone.input.trials,
        ],
        features=expand(rules.describe_demonstrations.output.features, object=DEMONSTRATED),
    output:
        runs="reports/demonstration_runs.json",
    params:
        settings=settings("predictors") | {"demonstrations": settings("demonstrations", "sheet")},
        tracking=settings("tracking"),
        hand=Path(config["hand"]).name,
        code=script_hash("publish_demonstrations"),
    message:
        "Publishing the model that is shown the task to MLflow"
    script:
        "../scripts/publish_demonstrations.py"


rule demonstrations:
    input:
        rules.tabulate_demonstrations.output,
        rules.plot_demonstrations.output,
        rules.tabulate_grasps_alone.output,
        rules.plot_grasps_alone.output,
        rules.publish_demonstrations.output,
    message:
        "Demonstrations rendered, learnt from and published"
