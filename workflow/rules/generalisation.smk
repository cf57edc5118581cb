# Do more shapes of every object help on unseen objects? `snakemake reports/generalisation.csv`
# A separate target, since no other result needs it. Only features are computed for the variants.


rule picture_variants:
    input:
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/generalisation/features/{object}.npz",
    wildcard_constraints:
        object="|".join(config["objects"]["names"]) or "none",
    params:
        settings={
            "objects": variant_settings(),
            "renders": settings("renders", "views", "sheet"),
            "features": settings("features"),
            "tasks": PARAMS.colour_shifts,
            "views": variant_views(),
        },
        seed=config["seed"],
        code=script_hash("picture_variants"),
    message:
        "Rendering variants of {wildcards.object}"
    script:
        "../scripts/picture_variants.py"


rule leave_out_shapes:
    input:
        objects=lambda wildcards: expand(
            rules.extract_features.output.features,
            object=varied_objects(wildcards.labels),
        ),
        variants=lambda wildcards: expand(
            rules.picture_variants.output.features, object=varied_objects(wildcards.labels)
        ),
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics="data/generalisation/{labels}/{model}.csv",
    params:
        settings=lambda wildcards: {
            "tasks": learning_tasks(wildcards),
            "predictors": settings("predictors"),
            **settings("generalisation"),
        },
        seed=config["seed"],
        code=script_hash("leave_out_shapes"),
    message:
        "Testing {wildcards.model} on objects left out in all shapes ({wildcards.labels} labels)"
    script:
        "../scripts/leave_out_shapes.py"


rule tabulate_generalisation:
    input:
        metrics=expand(rules.leave_out_shapes.output.metrics, labels=LABELS, model=PAPER_MODELS),
        samples=[SAMPLES[labels] for labels in LABELS],
    output:
        table=report(
            "reports/generalisation.csv",
            caption="../report/generalisation.rst",
            category="Unseen objects",
            labels={"subject": "more shapes", "labels": "both", "kind": "table"},
        ),
        figure=report(
            "reports/generalisation.png",
            caption="../report/generalisation.rst",
            category="Unseen objects",
            labels={"subject": "more shapes", "labels": "both", "kind": "figure"},
        ),
    params:
        labels=LABELS,
        code=script_hash("tabulate_generalisation"),
    message:
        "Tabulating the effect of more shapes on unseen objects"
    script:
        "../scripts/tabulate_generalisation.py"
