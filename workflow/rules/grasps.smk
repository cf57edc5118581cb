# Grasps: synthesized after the contact maps, tested in physics.


rule synthesize_grasps:
    input:
        distance_grid=rules.prepare_object.output.distance_grid,
        collision=rules.prepare_object.output.collision,
        properties=rules.prepare_object.output.properties,
        contact_map=rules.map_contacts.output.contact_map,
        hand="assets/barrett_hand/barrett_hand.urdf",
    output:
        grasps="data/grasps/{object}/{task}.parquet",
        attempts="data/attempts/{object}/{task}.parquet",
    log:
        "logs/synthesize_grasps/{object}_{task}.log",
    benchmark:
        "logs/benchmarks/synthesize_grasps/{object}_{task}.tsv"
    conda:
        "../envs/grasptypes.yaml"
    params:
        synthesis=settings("synthesis"),
        physics=settings("physics"),
        hand=hand_hashes("assets/barrett_hand"),
        seed=config["seed"],
        code=script_hash("synthesize_grasps"),
    message:
        "Grasping {wildcards.object} for {wildcards.task}"
    script:
        "../scripts/synthesize_grasps.py"


rule grasps:
    input:
        expand(rules.synthesize_grasps.output, object=OBJECTS, task=TASKS),
    message:
        "All grasps are synthesized"


rule picture_grasps:
    input:
        grasps=lambda wildcards: expand(
            rules.synthesize_grasps.output.grasps, object=wildcards.object, task=TASKS
        ),
        visual=rules.prepare_object.output.visual,
    output:
        pictures="data/screenshots/{object}.zip",
    log:
        "logs/picture_grasps/{object}.log",
    benchmark:
        "logs/benchmarks/picture_grasps/{object}.tsv"
    conda:
        "../envs/grasptypes.yaml"
    params:
        tasks=TASKS,
        renders=settings("renders", "views", "sheet"),
        settings=settings("gallery", "size_px", "tile_px", "columns"),
        code=script_hash("picture_grasps"),
    message:
        "Taking a picture of every grasp of {wildcards.object}"
    script:
        "../scripts/picture_grasps.py"


rule plot_grasps:
    input:
        grasps=expand(rules.synthesize_grasps.output.grasps, object=OBJECTS, task=TASKS),
        visuals=expand(rules.prepare_object.output.visual, object=OBJECTS),
    output:
        sheet=report(
            "reports/figures/gallery.png",
            caption="../report/gallery.rst",
            category="Grasps",
            labels={"subject": "gallery", "kind": "figure"},
        ),
    log:
        "logs/plot_grasps.log",
    benchmark:
        "logs/benchmarks/plot_grasps.tsv"
    conda:
        "../envs/grasptypes.yaml"
    params:
        names=[(name, task) for name in OBJECTS for task in TASKS],
        objects=OBJECTS,
        renders=settings("renders", "views", "sheet"),
        settings=settings("gallery", "screenshot_px"),
        code=script_hash("plot_grasps"),
    message:
        "Drawing the gallery of grasps"
    script:
        "../scripts/plot_grasps.py"


rule screenshots:
    input:
        expand(rules.picture_grasps.output, object=OBJECTS),
    message:
        "All grasps are pictured"
