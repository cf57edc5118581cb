# Details behind the tables: grasp types, objects, folds, losses, and the cost of the jobs.
NAMES = [(labels, model) for labels in LABELS for model in MODELS]
# Label sources with tasks to compare.
COMPARED = [labels for labels in LABELS if len(KNOWN[labels].tasks) > 1]


rule tabulate_types:
    input:
        predictions=expand(rules.train_predictor.output.predictions, labels=LABELS, model=MODELS),
        samples=[SAMPLES[labels] for labels in LABELS],
    output:
        table=report(
            "reports/type_results.csv",
            caption="../report/type_results.rst",
            category="Results",
            labels={"subject": "grasp types", "labels": "both", "kind": "table"},
        ),
        figure=report(
            "reports/figures/type_results.png",
            caption="../report/type_results.rst",
            category="Results",
            labels={"subject": "grasp types", "labels": "both", "kind": "figure"},
        ),
    params:
        names=NAMES,
        labels=LABELS,
        code=script_hash("tabulate_types"),
    message:
        "Tabulating the models by grasp type"
    script:
        "../scripts/tabulate_types.py"


# What each model gets wrong. The names are those in MLflow, which shows them.
rule plot_misclassified:
    input:
        predictions=rules.tabulate_types.input.predictions,
        samples=rules.tabulate_types.input.samples,
        pictures=expand(rules.render_object.output.pictures, object=OBJECTS),
    output:
        figures=expand(
            "reports/figures/misclassified_{labels}_{model}.png", labels=LABELS, model=MODELS
        ),
    params:
        names=NAMES,
        labels=LABELS,
        objects=OBJECTS,
        code=script_hash("plot_misclassified"),
    message:
        "Drawing the images that the models get wrong"
    script:
        "../scripts/plot_misclassified.py"


rule tabulate_objects:
    input:
        predictions=rules.tabulate_types.input.predictions,
        unseen=expand(rules.leave_out_objects.output.metrics, labels=LABELS, model=MODELS),
        samples=[SAMPLES[labels] for labels in LABELS],
    output:
        table=report(
            "reports/object_results.csv",
            caption="../report/object_results.rst",
            category="Results",
            labels={"subject": "objects", "labels": "both", "kind": "table"},
        ),
        figure=report(
            "reports/figures/object_results.png",
            caption="../report/object_results.rst",
            category="Results",
            labels={"subject": "objects", "labels": "both", "kind": "figure"},
        ),
    params:
        names=NAMES,
        labels=LABELS,
        code=script_hash("tabulate_objects"),
    message:
        "Tabulating the models by object"
    script:
        "../scripts/tabulate_objects.py"


rule plot_folds:
    input:
        metrics=expand(rules.train_predictor.output.metrics, labels=LABELS, model=MODELS),
    output:
        figure=report(
            "reports/figures/fold_spread.png",
            caption="../report/fold_spread.rst",
            category="Folds",
            labels={"subject": "spread", "labels": "both", "model": "all"},
        ),
    params:
        code=script_hash("plot_folds"),
    message:
        "Drawing the spread over folds and seeds"
    script:
        "../scripts/plot_folds.py"


rule plot_losses:
    input:
        curves=expand(rules.train_predictor.output.curves, labels=LABELS, model=MODELS),
    output:
        figure=report(
            "reports/figures/loss_curves.png",
            caption="../report/loss_curves.rst",
            category="Folds",
            labels={"subject": "losses", "labels": "both", "model": "all"},
        ),
    params:
        names=NAMES,
        code=script_hash("plot_losses"),
    message:
        "Drawing the losses"
    script:
        "../scripts/plot_losses.py"


rule analyse_labels:
    input:
        samples=[SAMPLES[labels] for labels in COMPARED],
    output:
        table=report(
            "reports/label_analysis.csv",
            caption="../report/label_analysis.rst",
            category="Grasp types",
            labels={"subject": "label analysis", "kind": "table"},
        ),
        figure=report(
            "reports/figures/label_analysis.png",
            caption="../report/label_analysis.rst",
            category="Grasp types",
            labels={"subject": "label analysis", "kind": "figure"},
        ),
        changes=report(
            "reports/figures/task_changes.png",
            caption="../report/task_changes.rst",
            category="Grasp types",
            labels={"subject": "task changes", "kind": "figure"},
        ),
    params:
        labels=COMPARED,
        code=script_hash("analyse_labels"),
    message:
        "Analysing the labels"
    script:
        "../scripts/analyse_labels.py"


# The cost of jobs differs between runs: `make report` draws it from this machine's benchmarks, and
# neither Snakemake nor DVC stores it. This rule only shows existing files in the report.
rule timing:
    input:
        figure=report(
            "build/timing.png",
            caption="../report/timing.rst",
            category="Timing",
            labels={"kind": "figure"},
        ),
        table=report(
            "build/timing.csv",
            caption="../report/timing.rst",
            category="Timing",
            labels={"kind": "table"},
        ),
    message:
        "Costs of all jobs drawn"
