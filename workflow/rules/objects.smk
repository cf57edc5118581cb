# Objects and where people touch them.


rule prepare_object:
    output:
        visual="data/objects/{object}/visual.glb",
        surface="data/objects/{object}/surface.npz",
        collision="data/objects/{object}/collision.obj",
        distance_grid="data/objects/{object}/distance_grid.npz",
        properties="data/objects/{object}/properties.json",
    log:
        "logs/prepare_object/{object}.log",
    benchmark:
        "logs/benchmarks/prepare_object/{object}.tsv"
    params:
        settings=settings("objects", "names", "own"),
        own=lambda wildcards: config["objects"]["own"].get(wildcards.object),
        code=script_hash("prepare_object"),
    message:
        "Preparing {wildcards.object}"
    script:
        "../scripts/prepare_object.py"


rule map_contacts:
    input:
        surface=rules.prepare_object.output.surface,
        properties=rules.prepare_object.output.properties,
        affinities=config["contact_maps"]["affinities"],
    output:
        contact_map="data/contact_maps/{object}/{task}.npz",
    log:
        "logs/map_contacts/{object}_{task}.log",
    benchmark:
        "logs/benchmarks/map_contacts/{object}_{task}.tsv"
    params:
        settings=settings("contact_maps"),
        objects=OBJECTS,
        tasks=TASKS,
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
        "All objects are prepared"


rule contact_maps:
    input:
        expand(rules.map_contacts.output, object=OBJECTS, task=TASKS),
    message:
        "All contact maps are drawn"
