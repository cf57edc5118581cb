# The kinds that the predictor for unseen objects names: `snakemake data/general/trained/known_kinds.zip`
rule picture_kinds:
    input:
        visuals=every_shape(rules.prepare_kind.output.visual),
        object_visuals=expand("data/objects/{object}/visual.glb", object=OBJECTS),
    output:
        looks="data/general/trained/known_kinds.zip",
    params:
        picture_px=config["predict"]["known_kinds"]["picture_px"],
        camera=settings("renders", "views", "sheet"),
        code=script_hash("picture_kinds"),
    message:
        "Taking pictures of known kinds"
    script:
        "../scripts/picture_kinds.py"
