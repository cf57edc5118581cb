# Renders of the objects.


rule render_object:
    input:
        visual="data/objects/{object}/visual.glb",
    output:
        pictures="data/renders/{object}.zip",
        poses="data/renders/{object}.csv",
    params:
        views=view_count,
        settings=settings("renders", "views", "sheet"),
        seed=config["seed"],
        code=script_hash("render_object"),
    message:
        "Rendering {wildcards.object}"
    script:
        "../scripts/render_object.py"


rule plot_renders:
    input:
        pictures=expand(rules.render_object.output.pictures, object=OBJECTS),
    output:
        sheet=report(
            "reports/figures/renders.png",
            caption="../report/renders.rst",
            category="Objects",
            labels={"subject": "renders", "kind": "figure"},
        ),
    params:
        objects=OBJECTS,
        sheet=config["renders"]["sheet"],
        compression=config["renders"]["png_compression"],
        code=script_hash("plot_renders"),
    message:
        "Laying out the sheet of renders"
    script:
        "../scripts/plot_renders.py"


rule renders:
    input:
        expand(rules.render_object.output, object=OBJECTS),
        rules.plot_renders.output,
    message:
        "All objects rendered"
