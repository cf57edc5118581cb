# The hand at the published poses: a check of frames, scale and kinematics.


# Only needed if the published table is given by URL; the URL contains its checksum.
rule fetch_published:
    output:
        table=FETCHED,
    params:
        address=list(published_address(os.environ) or []),
        timeout_s=config["published"]["timeout_s"],
        code=script_hash("fetch_published"),
    message:
        "Downloading the published grasps"
    script:
        "../scripts/fetch_published.py"


rule replay_grasps:
    input:
        published=PUBLISHED_CSV,
        references=REFERENCE_MESHES,
    output:
        table=report(
            "reports/replay.csv",
            caption="../report/replay.rst",
            category="Grasps",
            labels={"subject": "published poses", "kind": "table"},
        ),
    params:
        hand=hand_parameter(config["published"]["hand"]),
        settings=config["replay"],
        data=lambda wildcards: measuring_hashes(),
        code=script_hash("replay_grasps"),
    message:
        "Replaying the published hand poses"
    script:
        "../scripts/replay_grasps.py"


# Not part of any other target: its findings are in src/grasptypes/settings/tasks.yaml. Only objects on whose
# labels anything is fitted.
rule measure_touched_roles:
    input:
        surfaces=expand(rules.prepare_object.output.surface, object=FITTED_ON),
        properties=expand(rules.prepare_object.output.properties, object=FITTED_ON),
        published=PUBLISHED_CSV,
        references=REFERENCE_MESHES,
    output:
        table="reports/touched_roles.csv",
    params:
        hand=hand_parameter(config["published"]["hand"]),
        objects=FITTED_ON,
        scale=config["replay"]["object_scale"],
        data=lambda wildcards: measuring_hashes(),
        settings=config["hold_fit"]["touch"],
        code=script_hash("measure_touched_roles"),
    message:
        "Measuring which roles the published grasps touch"
    script:
        "../scripts/measure_touched_roles.py"
