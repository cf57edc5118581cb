# How many images of each object do the models need? Not part of the main job: `snakemake reports/learning_curve.csv`


rule learn_from_fewer_views:
    input:
        inputs=lambda wildcards: expand(
            rules.extract_features.output.features, object=KNOWN[wildcards.labels].objects
        ),
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics="data/learning_curve/{labels}/{model}.csv",
    params:
        views=config["learning_curve"]["views"],
        settings=settings("predictors"),
        tasks=learning_tasks,
        seed=config["seed"],
        code=script_hash("learn_from_fewer_views"),
    message:
        "Training {wildcards.model} with fewer images ({wildcards.labels} labels)"
    script:
        "../scripts/learn_from_fewer_views.py"


rule plot_learning_curve:
    input:
        metrics=expand(
            rules.learn_from_fewer_views.output.metrics,
            labels=CONTROLLED,
            model=config["learning_curve"]["models"],
        ),
        samples=[SAMPLES[labels] for labels in CONTROLLED],
    output:
        table=report(
            "reports/learning_curve.csv",
            caption="../report/learning_curve.rst",
            category="Results",
            labels={"subject": "learning curve", "kind": "table"},
        ),
        figure=report(
            "reports/figures/learning_curve.png",
            caption="../report/learning_curve.rst",
            category="Results",
            labels={"subject": "learning curve", "kind": "figure"},
        ),
    params:
        labels=CONTROLLED,
        code=script_hash("plot_learning_curve"),
    message:
        "Drawing the learning curve"
    script:
        "../scripts/plot_learning_curve.py"
