# Objects, and where people touch them.


rule prepare_object:
    input:
        own=own_files,
    output:
        visual="data/objects/{object}/visual.glb",
        surface="data/objects/{object}/surface.npz",
        collision="data/objects/{object}/collision.obj",
        distance_grid="data/objects/{object}/distance_grid.npz",
        properties="data/objects/{object}/properties.json",
    wildcard_constraints:
        object="|".join(name for name in OBJECTS if name not in VARIANTS),
    params:
        settings=object_settings,
        own=lambda wildcards: hashes(own_files(wildcards)),
        code=script_hash("prepare_object"),
    message:
        "Preparing {wildcards.object}"
    script:
        "../scripts/prepare_object.py"


rule prepare_variant:
    output:
        visual="data/objects/{object}/visual.glb",
        surface="data/objects/{object}/surface.npz",
        collision="data/objects/{object}/collision.obj",
        distance_grid="data/objects/{object}/distance_grid.npz",
        properties="data/objects/{object}/properties.json",
    wildcard_constraints:
        # Matches no object if there are no variants.
        object="|".join(VARIANTS) or "none",
    params:
        settings=variant_settings(),
        seed=config["seed"],
        code=script_hash("prepare_variant"),
    message:
        "Preparing {wildcards.object}"
    script:
        "../scripts/prepare_variant.py"


rule map_contacts:
    input:
        surface=rules.prepare_object.output.surface,
        properties=rules.prepare_object.output.properties,
        measured=measured_input,
    output:
        contact_map="data/contact_maps/{object}/{task}.npz",
    params:
        settings=settings("contact_maps"),
        segmentation=settings("segmentation", "samples", "training", "forest"),
        network=hashes(str(NETWORK)),
        knowledge=hashes(KNOWLEDGE),
        unit=lambda wildcards: map_unit(wildcards.object),
        measured=lambda wildcards: hashes(measured_input(wildcards)),
        seed=config["seed"],
        code=script_hash("map_contacts"),
    message:
        "Mapping contacts of {wildcards.object} for {wildcards.task}"
    script:
        "../scripts/map_contacts.py"


rule objects:
    input:
        expand(rules.prepare_object.output, object=OBJECTS),
    message:
        "All objects prepared"


rule contact_maps:
    input:
        expand(rules.map_contacts.output, object=OBJECTS, task=TASKS),
    message:
        "All contact maps computed"


# Few users have the reference meshes, so this is not part of any other target.
rule compare_shapes:
    input:
        references=REFERENCE_MESHES,
        properties=expand(rules.prepare_object.output.properties, object=OBJECTS),
        surfaces=expand(rules.prepare_object.output.surface, object=OBJECTS),
    output:
        table=report(
            "reports/object_shapes.csv",
            caption="../report/object_shapes.rst",
            category="Objects",
            labels={"subject": "shapes against scans", "kind": "table"},
        ),
    params:
        samples=config["objects"]["comparison"],
        data=lambda wildcards: hashes(REFERENCE_MESHES),
        code=script_hash("compare_shapes"),
    message:
        "Comparing the objects with reference meshes"
    script:
        "../scripts/compare_shapes.py"


rule plot_contact_maps:
    input:
        contact_maps=expand(rules.map_contacts.output.contact_map, object=OBJECTS, task=TASKS),
        surfaces=expand(rules.prepare_object.output.surface, object=OBJECTS),
    output:
        pictures=expand(
            "reports/figures/contact_maps/{object}_{task}.png", object=OBJECTS, task=TASKS
        ),
        sheet=report(
            "reports/figures/contact_maps.png",
            caption="../report/contact_maps.rst",
            category="Objects",
            labels={"subject": "contact maps", "kind": "figure"},
        ),
    params:
        names=[(name, task) for name in OBJECTS for task in TASKS],
        objects=OBJECTS,
        renders=settings("renders", "views", "sheet"),
        settings=settings("contact_pictures"),
        code=script_hash("plot_contact_maps"),
    message:
        "Drawing the contact maps"
    script:
        "../scripts/plot_contact_maps.py"
