# Kinds of objects: the same rules for every shape of every kind. `snakemake -j2 kinds`
# A separate target, since no other result needs it; its files have folders of their own.


rule prepare_kind:
    output:
        visual="data/kinds/objects/{object}/visual.glb",
        surface="data/kinds/objects/{object}/surface.npz",
        collision="data/kinds/objects/{object}/collision.obj",
        distance_grid="data/kinds/objects/{object}/distance_grid.npz",
        properties="data/kinds/objects/{object}/properties.json",
        roles="data/kinds/meshes/{object}.ply",
    wildcard_constraints:
        object=SHAPE_PATTERN,
    params:
        settings=config["objects"]["resolution"],
        kind=lambda wildcards: kind_hash(shape_of(wildcards.object)[0]),
        code=script_hash("prepare_kind"),
    message:
        "Preparing {wildcards.object}"
    script:
        "../scripts/prepare_kind.py"


use rule map_contacts as map_kind_contacts with:
    input:
        surface=rules.prepare_kind.output.surface,
        properties=rules.prepare_kind.output.properties,
        measured=[],
    output:
        contact_map="data/kinds/contact_maps/{object}/{task}.npz",
    wildcard_constraints:
        object=SHAPE_PATTERN,
    params:
        settings=settings("contact_maps") | {"sessions": config["kinds"]["sessions"]},


use rule synthesize_grasps as synthesize_kind_grasps with:
    input:
        distance_grid=rules.prepare_kind.output.distance_grid,
        collision=rules.prepare_kind.output.collision,
        properties=rules.prepare_kind.output.properties,
        contact_map=rules.map_kind_contacts.output.contact_map,
    output:
        grasps="data/kinds/grasps/{object}/{task}.parquet",
        attempts="data/kinds/attempts/{object}/{task}.parquet",
    wildcard_constraints:
        object=SHAPE_PATTERN,


use rule label_grasps as label_kind_grasps with:
    input:
        grasps=every_shape(rules.synthesize_kind_grasps.output.grasps),
        grids=every_shape(rules.prepare_kind.output.distance_grid),
    output:
        grasps="data/kinds/grasps.csv",
        samples="data/kinds/samples.csv",
    params:
        least=config["kinds"]["least_grasps"],


use rule render_object as render_kind with:
    input:
        visual=rules.prepare_kind.output.visual,
    output:
        pictures="data/kinds/renders/{object}.zip",
        poses="data/kinds/renders/{object}.csv",
    wildcard_constraints:
        object=SHAPE_PATTERN,


rule tabulate_kinds:
    input:
        dataset=rules.label_kind_grasps.output.grasps,
        grasps=every_shape(rules.synthesize_kind_grasps.output.grasps),
        surfaces=every_shape(rules.prepare_kind.output.surface),
        properties=every_shape(rules.prepare_kind.output.properties),
    output:
        kinds="reports/kinds.csv",
        roles="reports/types_by_role.csv",
    params:
        hand=hand_parameter(config["hand"]),
        code=script_hash("tabulate_kinds"),
    message:
        "Tabulating the grasps of all kinds"
    script:
        "../scripts/tabulate_kinds.py"


rule plot_kinds:
    output:
        sheet="reports/kinds/{group}.png",
    wildcard_constraints:
        group="[a-z]+",
    params:
        sheet=config["kinds"]["sheet"],
        names=lambda wildcards: kinds_of(wildcards.group),
        blocks=lambda wildcards: kind_hash(*kinds_of(wildcards.group)),
        renders=settings("renders", "views", "sheet"),
        crease_deg=config["objects"]["resolution"]["crease_deg"],
        code=script_hash("plot_kinds"),
    message:
        "Drawing the contact sheet of {wildcards.group}"
    script:
        "../scripts/plot_kinds.py"


# Few users have these data, so this is not part of any other target. GRASPTYPES_YCB names a checkout of
# elpis-lab/YCB_Dataset, GRASPTYPES_FURNITURE a folder of Sweet Home 3D's libraries.
rule compare_kind_sizes:
    output:
        table="reports/kind_sizes.csv",
    params:
        folders=lambda wildcards: real_objects(os.environ),
        blocks=lambda wildcards: kind_hash(*kind_names()),
        code=script_hash("compare_kind_sizes"),
    message:
        "Comparing kinds with real objects"
    script:
        "../scripts/compare_kind_sizes.py"


rule kind_sheets:
    input:
        kind_sheets,
    message:
        "All contact sheets of kinds drawn"


rule kinds:
    input:
        rules.label_kind_grasps.output,
        rules.tabulate_kinds.output,
        every_shape(rules.render_kind.output.pictures, rules.render_kind.output.poses),
        every_shape(rules.prepare_kind.output.roles),
        kind_sheets,
    message:
        "All kinds grasped, labelled and rendered"
