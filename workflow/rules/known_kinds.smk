# What the predictor for unseen objects compares images with: `snakemake data/general/trained/known_kinds.npz`
rule know_kinds:
    input:
        kinds="data/general/features/kinds.npz",
        objects="data/general/features/objects.npz",
        visuals=every_shape(rules.prepare_kind.output.visual),
        object_visuals=expand("data/objects/{object}/visual.glb", object=OBJECTS),
    output:
        known="data/general/trained/known_kinds.npz",
        looks="data/general/trained/known_kinds.zip",
    params:
        settings=config["predict"]["known_kinds"],
        families=config["general"]["protocol"]["families"],
        backbone=config["general"]["backbone"],
        timeout_s=config["backbone"]["timeout_s"],
        weights=weights_choice(),
        camera=settings("renders", "views", "sheet"),
        seed=config["seed"],
        code=script_hash("know_kinds"),
    message:
        "Learning what known kinds look like"
    script:
        "../scripts/know_kinds.py"
