# Images of grasps, and their sheets.


rule picture_grasps:
    input:
        grasps=lambda wildcards: expand(
            rules.synthesize_grasps.output.grasps, object=wildcards.object, task=TASKS
        ),
        visual=rules.prepare_object.output.visual,
    output:
        pictures="data/screenshots/{object}.zip",
    params:
        hand=hand_parameter(config["hand"]),
        tasks=TASKS,
        renders=settings("renders", "views", "sheet"),
        settings=config["gallery"],
        code=script_hash("picture_grasps"),
    message:
        "Rendering all grasps of {wildcards.object}"
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
    params:
        hand=hand_parameter(config["hand"]),
        names=[(name, task) for name in OBJECTS for task in TASKS],
        objects=OBJECTS,
        renders=settings("renders", "views", "sheet"),
        settings=config["gallery"],
        code=script_hash("plot_grasps"),
    message:
        "Drawing the gallery of grasps"
    script:
        "../scripts/plot_grasps.py"


rule show_grasps:
    input:
        dataset="data/grasps.csv",
        grasps=expand(rules.synthesize_grasps.output.grasps, object=OBJECTS, task=TASKS),
        maps=expand(rules.map_contacts.output, object=OBJECTS, task=TASKS),
        visuals=expand(rules.prepare_object.output.visual, object=OBJECTS),
        surfaces=expand(rules.prepare_object.output.surface, object=OBJECTS),
    output:
        page=report(
            "reports/grasps.html",
            caption="../report/grasps.rst",
            category="Grasps",
            labels={"subject": "all grasps in 3D", "kind": "page"},
        ),
    params:
        hand=hand_parameter(config["hand"]),
        page=hashes([f"{ROOT}/src/grasptypes/viewer/{name}" for name in PAGE_FILES]),
        code=script_hash("show_grasps"),
    message:
        "Writing the page of all grasps"
    script:
        "../scripts/show_grasps.py"


rule plot_rejected_grasps:
    input:
        attempts=expand(rules.synthesize_grasps.output.attempts, object=OBJECTS, task=TASKS),
        visuals=expand(rules.prepare_object.output.visual, object=OBJECTS),
    output:
        sheet=report(
            "reports/figures/rejected_grasps.png",
            caption="../report/rejected_grasps.rst",
            category="Grasps",
            labels={"subject": "rejected grasps", "kind": "figure"},
        ),
    params:
        hand=hand_parameter(config["hand"]),
        objects=OBJECTS,
        renders=settings("renders", "views", "sheet"),
        settings=config["gallery"],
        code=script_hash("plot_rejected_grasps"),
    message:
        "Drawing examples of rejected grasps"
    script:
        "../scripts/plot_rejected_grasps.py"


rule plot_sessions:
    input:
        dataset="data/grasps.csv",
        pictures=expand(rules.picture_grasps.output.pictures, object=OBJECTS),
    output:
        sheets=[
            report(
                f"reports/figures/grasps/{name}.png",
                caption="../report/sessions.rst",
                category="Grasps",
                subcategory="All grasps of an object",
                labels={"object": name},
            )
            for name in OBJECTS
        ],
    params:
        hand=hand_parameter(config["hand"]),
        objects=OBJECTS,
        tasks=TASKS,
        settings=config["gallery"]["sessions"],
        png_compression=config["renders"]["png_compression"],
        code=script_hash("plot_sessions"),
    message:
        "Laying out all grasps of every object"
    script:
        "../scripts/plot_sessions.py"


rule screenshots:
    input:
        expand(rules.picture_grasps.output, object=OBJECTS),
    message:
        "All grasps rendered"
