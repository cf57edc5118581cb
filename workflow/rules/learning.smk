# From renders and labels to features, folds and predictors.
PAPER_MODELS = ["no_task", "task_vector", "task_in_image", "ignores_task"]
MODELS = [*PAPER_MODELS, "e_mobilenet_v2"]
SAMPLES = {"simulated": "data/samples.csv", "published": "data/published_samples.csv"}
LABELS = config["labels"]
# Whether objects can be left out: at least one other must remain to learn from.
UNSEEN = all(len(set(map(base_of, KNOWN[labels].objects))) > 1 for labels in LABELS)


wildcard_constraints:
    labels="|".join(SAMPLES),
    model="|".join(MODELS),


rule label_published:
    input:
        counts=PUBLISHED_COUNTS,
    output:
        samples=SAMPLES["published"],
    params:
        objects=KNOWN["published"].objects,
        tasks=KNOWN["published"].tasks,
        published=hashes(PUBLISHED_COUNTS),
        code=script_hash("label_published"),
    message:
        "Turning the published counts into samples"
    script:
        "../scripts/label_published.py"


rule prepare_backbone:
    output:
        record="data/backbone.json",
    params:
        timeout_s=config["backbone"]["timeout_s"],
        input_px=config["backbone"]["input_px"],
        weights=weights_choice(),
        code=script_hash("prepare_backbone"),
    message:
        "Finding the backbone's weights"
    script:
        "../scripts/prepare_backbone.py"


rule extract_features:
    input:
        pictures=rules.render_object.output.pictures,
        backbone=rules.prepare_backbone.output.record,
    output:
        features="data/features/{object}.npz",
    params:
        settings=settings("features"),
        tasks=PARAMS.colour_shifts,
        code=script_hash("extract_features"),
    message:
        "Extracting features of {wildcards.object}"
    script:
        "../scripts/extract_features.py"


rule split_folds:
    input:
        poses=expand(rules.render_object.output.poses, object=OBJECTS),
    output:
        folds="data/folds.csv",
    params:
        folds=config["folds"]["count"],
        seed=config["seed"],
        code=script_hash("split_folds"),
    message:
        "Splitting the images into folds"
    script:
        "../scripts/split_folds.py"


rule train_predictor:
    input:
        inputs=learning_inputs,
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics=report(
            "reports/metrics/{labels}/{model}.csv",
            caption="../report/metrics.rst",
            category="Folds",
            labels={"subject": "metrics", "labels": "{labels}", "model": "{model}"},
        ),
        curves="reports/loss_curves/{labels}/{model}.csv",
        predictions="models/{labels}/{model}/predictions.parquet",
        tensors="models/{labels}/{model}/predictor.safetensors",
        card="models/{labels}/{model}/predictor.json",
    params:
        settings=settings("predictors"),
        tasks=learning_tasks,
        seed=config["seed"],
        code=script_hash("train_predictor"),
    message:
        "Training {wildcards.model} on {wildcards.labels} labels"
    script:
        "../scripts/train_predictor.py"


rule leave_out_objects:
    input:
        inputs=learning_inputs,
        samples=lambda wildcards: SAMPLES[wildcards.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
    output:
        metrics="reports/unseen/{labels}/{model}.csv",
    params:
        settings=settings("predictors"),
        tasks=learning_tasks,
        seed=config["seed"],
        code=script_hash("leave_out_objects"),
    message:
        "Testing {wildcards.model} on unseen objects ({wildcards.labels} labels)"
    script:
        "../scripts/leave_out_objects.py"


rule features:
    input:
        expand(rules.extract_features.output, object=OBJECTS),
    message:
        "All features extracted"


rule predictors:
    input:
        expand(rules.train_predictor.output, labels=LABELS, model=MODELS),
        expand(rules.leave_out_objects.output, labels=LABELS, model=MODELS) if UNSEEN else [],
    message:
        "All predictors trained and tested"
