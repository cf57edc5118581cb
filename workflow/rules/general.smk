# The predictor for unseen objects: `snakemake -j2 reports/table3.csv`
# A separate target, since no other result needs it, and its labels, those of all kinds, take hours.
GENERAL = PARAMS.general


rule picture_randomly:
    input:
        visual=lambda wildcards: (
            "data/objects/{object}/visual.glb"
            if wildcards.object in OBJECTS
            else rules.prepare_kind.output.visual
        ),
    output:
        pictures="data/general/pictures/{object}.zip",
    wildcard_constraints:
        object="|".join([*OBJECTS, SHAPE_PATTERN]),
    params:
        settings=config["general"]["images"],
        camera=settings("renders", "views", "sheet"),
        seed=config["seed"],
        code=script_hash("picture_randomly"),
    message:
        "Taking randomised pictures of {wildcards.object}"
    script:
        "../scripts/picture_randomly.py"


rule picture_scan:
    output:
        pictures="data/general/scans/{object}.zip",
    params:
        scan=lambda wildcards: scanned()[wildcards.object],
        mesh=lambda wildcards: hashes(scanned()[wildcards.object]),
        views=config["general"]["protocol"]["test_views"],
        crease_deg=config["objects"]["resolution"]["crease_deg"],
        settings=config["objects"]["import"],
        camera=settings("renders", "views", "sheet"),
        code=script_hash("picture_scan"),
    message:
        "Taking pictures of the scan of {wildcards.object}"
    script:
        "../scripts/picture_scan.py"


# One job for many objects: loading torch takes longer than the images of one.
rule describe_pictures:
    input:
        pictures=pictures_of,
    output:
        features="data/general/features/{shown}.npz",
    wildcard_constraints:
        shown="kinds|objects|renders|scans",
    params:
        backbone=config["general"]["backbone"],
        settings=config["backbone"],
        batch=config["features"]["batch"],
        weights=weights_choice(),
        code=script_hash("describe_pictures"),
    message:
        "Describing pictures of {wildcards.shown}"
    script:
        "../scripts/describe_pictures.py"


# The images of kinds as backbones see them that are only compared.
use rule describe_pictures as describe_for_trial with:
    input:
        pictures=lambda wildcards: random_pictures(*shapes()),
    output:
        features="data/general/backbones/{backbone}.npz",
    wildcard_constraints:
        backbone=r"\w+",
    params:
        backbone=lambda wildcards: wildcards.backbone,
        settings=config["backbone"],
        batch=config["features"]["batch"],
        weights=weights_choice(),
        code=script_hash("describe_pictures"),
    message:
        "Describing pictures of kinds with {wildcards.backbone}"


# For those who have photographs: GRASPTYPES_PHOTOGRAPHS names a folder with photographs.csv.
rule describe_photographs:
    output:
        features="data/general/features/photographs.npz",
    params:
        backbone=config["general"]["backbone"],
        settings=config["backbone"],
        limits=config["predict"]["photos"],
        batch=config["features"]["batch"],
        weights=weights_choice(),
        table=PHOTOGRAPHS[:1],
        objects=OBJECTS,
        files=hashes(PHOTOGRAPHS),
        code=script_hash("describe_photographs"),
    message:
        "Describing photographs"
    script:
        "../scripts/describe_photographs.py"


# For comparison with images.
rule describe_shapes:
    input:
        surfaces=surfaces_of,
    output:
        shapes="data/general/shapes/{shown}.npz",
    wildcard_constraints:
        shown="kinds|objects|scans",
    params:
        scans=lambda wildcards: scanned() if wildcards.shown == "scans" else {},
        files=lambda wildcards: hashes(scanned().values()) if wildcards.shown == "scans" else {},
        settings=config["objects"]["import"],
        segmentation=config["segmentation"],
        code=script_hash("describe_shapes"),
    message:
        "Describing the shapes of {wildcards.shown}"
    script:
        "../scripts/describe_shapes.py"


rule evaluate_general:
    input:
        kinds="data/general/features/kinds.npz",
        objects="data/general/features/objects.npz",
        renders="data/general/features/renders.npz",
        scans="data/general/features/scans.npz" if scanned() else [],
        shapes=expand("data/general/shapes/{shown}.npz", shown=["kinds", "objects"]),
        scan_shapes="data/general/shapes/scans.npz" if scanned() else [],
        photographs=rules.describe_photographs.output.features if PHOTOGRAPHS else [],
        kind_samples=rules.label_kind_grasps.output.samples,
        kind_properties=every_shape(rules.prepare_kind.output.properties),
        simulated=SAMPLES["simulated"],
        samples=[SAMPLES[labels] for labels in LABELS],
        properties=expand("data/objects/{object}/properties.json", object=OBJECTS),
    output:
        answers="data/general/answers.parquet",
    params:
        settings=settings("general", "trials"),
        predictors=config["predictors"],
        labels=LABELS,
        tasks=TASKS,
        scans={name: (path, config["objects"]["scale"]) for name, path in scanned().items()},
        meshes=hashes(scanned().values()),
        seed=config["seed"],
        code=script_hash("evaluate_general"),
    message:
        "Testing the predictor for unseen objects"
    script:
        "../scripts/evaluate_general.py"


rule train_general:
    input:
        kinds="data/general/features/kinds.npz",
        objects="data/general/features/objects.npz",
        kind_samples=rules.label_kind_grasps.output.samples,
        kind_properties=every_shape(rules.prepare_kind.output.properties),
        simulated=SAMPLES["simulated"],
        properties=expand("data/objects/{object}/properties.json", object=OBJECTS),
    output:
        head="data/general/trained/general.npz",
        card="data/general/trained/general.json",
    params:
        settings=settings("general", "trials"),
        backbone=config["backbone"],
        tasks=TASKS,
        seed=config["seed"],
        code=script_hash("train_general"),
    message:
        "Training the predictor for unseen objects"
    script:
        "../scripts/train_general.py"


rule try_general:
    input:
        kinds="data/general/features/kinds.npz",
        backbones=expand(
            rules.describe_for_trial.output.features, backbone=GENERAL.trials.get("backbone", [])
        ),
        samples=rules.label_kind_grasps.output.samples,
        properties=every_shape(rules.prepare_kind.output.properties),
    output:
        table="reports/general_trials.csv",
        figure=report(
            "reports/general_kinds.png",
            caption="../report/general_kinds.rst",
            category="Unseen objects",
            labels={"subject": "number of kinds", "labels": "simulated", "kind": "figure"},
        ),
    params:
        settings=config["general"],
        tasks=TASKS,
        seed=config["seed"],
        code=script_hash("try_general"),
    message:
        "Trying settings of the predictor for unseen objects"
    script:
        "../scripts/try_general.py"


rule tabulate_general:
    input:
        answers=rules.evaluate_general.output.answers,
        samples=[SAMPLES[labels] for labels in LABELS],
        kind_samples=rules.label_kind_grasps.output.samples,
    output:
        table=report(
            "reports/table3.csv",
            caption="../report/table3.rst",
            category="Unseen objects",
            labels={"subject": "Table III", "labels": "both", "kind": "table"},
        ),
        markdown="reports/table3.md",
        figure=report(
            "reports/calibration.png",
            caption="../report/table3.rst",
            category="Unseen objects",
            labels={"subject": "calibration", "labels": "both", "kind": "figure"},
        ),
    params:
        labels=LABELS,
        unfitted=[name for name in OBJECTS if name not in FITTED_ON],
        bins=config["general"]["protocol"]["bins"],
        code=script_hash("tabulate_general"),
    message:
        "Tabulating answers about unseen objects"
    script:
        "../scripts/tabulate_general.py"


rule analyse_general:
    input:
        answers=rules.evaluate_general.output.answers,
        dataset=rules.label_grasps.output.grasps,
        kind_dataset=rules.label_kind_grasps.output.grasps,
        samples=[SAMPLES[labels] for labels in LABELS],
        kind_samples=rules.label_kind_grasps.output.samples,
        properties=every_shape(rules.prepare_kind.output.properties),
        pictures=lambda wildcards: random_pictures(*shapes()),
    output:
        limits="reports/general_limits.csv",
        confusions="reports/general_confusions.csv",
        pictures=report(
            "reports/general_answers.jpg",
            caption="../report/table3.rst",
            category="Unseen objects",
            labels={"subject": "answers", "labels": "simulated", "kind": "figure"},
        ),
    params:
        labels=LABELS,
        hand=hand_parameter(config["hand"]),
        # Of the worst, and as many of the others.
        shown=10,
        code=script_hash("analyse_general"),
    message:
        "Analysing answers about unseen objects"
    script:
        "../scripts/analyse_general.py"


rule publish_general:
    input:
        answers=rules.evaluate_general.output.answers,
        samples=rules.label_kind_grasps.output.samples,
        table=rules.tabulate_general.output.table,
    output:
        runs="reports/general_runs.json",
    params:
        settings=settings("general", "trials"),
        tracking=settings("tracking"),
        hand=labelled_hand("simulated"),
        seed=config["seed"],
        code=script_hash("publish_general"),
    message:
        "Publishing the predictor for unseen objects to MLflow"
    script:
        "../scripts/publish_general.py"
