# Grasps: synthesized from the contact maps, tested in physics.


rule synthesize_grasps:
    input:
        distance_grid=rules.prepare_object.output.distance_grid,
        collision=rules.prepare_object.output.collision,
        properties=rules.prepare_object.output.properties,
        surface=rules.prepare_object.output.surface,
        contact_map=rules.map_contacts.output.contact_map,
    output:
        grasps="data/grasps/{object}/{task}.parquet",
        attempts="data/attempts/{object}/{task}.parquet",
    params:
        synthesis=settings("synthesis"),
        physics=settings("physics"),
        hand=hand_parameter(config["hand"]),
        tasks=hashes([TASKS_FILE]),
        seed=config["seed"],
        code=script_hash("synthesize_grasps"),
    message:
        "Synthesizing grasps of {wildcards.object} for {wildcards.task}"
    script:
        "../scripts/synthesize_grasps.py"


rule grasps:
    input:
        expand(rules.synthesize_grasps.output, object=OBJECTS, task=TASKS),
    message:
        "All grasps synthesized"
