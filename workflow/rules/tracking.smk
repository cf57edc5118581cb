# The runs in MLflow, a view of the models that can be rebuilt at any time: make ui


rule publish_runs:
    input:
        metrics=expand(rules.train_predictor.output.metrics, labels=LABELS, model=MODELS),
        curves=expand(rules.train_predictor.output.curves, labels=LABELS, model=MODELS),
        tensors=expand(rules.train_predictor.output.tensors, labels=LABELS, model=MODELS),
        cards=expand(rules.train_predictor.output.card, labels=LABELS, model=MODELS),
        samples=[SAMPLES[labels] for labels in LABELS],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
        renders=expand(rules.render_object.output.pictures, object=OBJECTS),
        features=expand(rules.extract_features.output.features, object=OBJECTS),
        # Shown with each model.
        figures=[
            *[TABLES[labels].figure for labels in LABELS],
            rules.tabulate_types.output.figure,
            *rules.plot_folds.output,
            *rules.plot_losses.output,
        ],
        # Each is shown with its model, in the order of the inputs.
        misclassified=rules.plot_misclassified.output.figures,
    output:
        runs="reports/runs.json",
    params:
        tracking=settings("tracking"),
        predictors=settings("predictors"),
        # Of each model, in the order of the inputs.
        hands=[labelled_hand(labels) for labels in LABELS for _ in MODELS],
        code=script_hash("publish_runs"),
    message:
        "Publishing the models to MLflow"
    script:
        "../scripts/publish_runs.py"
