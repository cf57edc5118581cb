# Parts and roles from shape: a network that learns from kinds, tested on families that it has not seen and on scans.
# `snakemake -j2 data/segmentation/network.npz` makes the file that comes with the package.


rule sample_kinds:
    output:
        samples="data/segmentation/samples/{group}.npz",
    wildcard_constraints:
        group="[a-z]+",
    params:
        descriptors=config["segmentation"]["descriptors"],
        settings=config["segmentation"]["samples"],
        names=lambda wildcards: kinds_of(wildcards.group),
        blocks=lambda wildcards: kind_hash(*kinds_of(wildcards.group)),
        code=script_hash("sample_kinds"),
    message:
        "Sampling the shapes of {wildcards.group}"
    script:
        "../scripts/sample_kinds.py"


rule train_role_network:
    input:
        samples=kind_samples,
    output:
        network="data/segmentation/network.npz",
    params:
        settings=config["segmentation"]["training"],
        fold=None,
        relatives=[],
        seed=config["seed"],
        code=script_hash("train_role_network"),
    message:
        "Training the network that names roles"
    script:
        "../scripts/train_role_network.py"


# Families that an object of the paper is related to are left out together.
RELATIVES = list(PARAMS.general.protocol.families.values())
ROLE_FOLDS = range(PARAMS.segmentation.training.folds)


use rule train_role_network as train_fold_network with:
    output:
        network="data/segmentation/networks/{fold}.npz",
    wildcard_constraints:
        fold=r"\d+",
    params:
        settings=config["segmentation"]["training"],
        fold=lambda wildcards: int(wildcards.fold),
        relatives=RELATIVES,
        seed=config["seed"],
        code=script_hash("train_role_network"),
    message:
        "Training the network that names roles without fold {wildcards.fold}"


rule evaluate_roles:
    input:
        samples=kind_samples,
        networks=expand(rules.train_fold_network.output.network, fold=ROLE_FOLDS),
    output:
        kinds="reports/kind_roles.csv",
        roles="reports/role_recognition.csv",
    params:
        settings=settings("segmentation"),
        relatives=RELATIVES,
        seed=config["seed"],
        code=script_hash("evaluate_roles"),
    message:
        "Testing methods that name roles on families that they have not seen"
    script:
        "../scripts/evaluate_roles.py"


# The 19 objects of the paper are no kinds, but kinds of their families exist.
rule compare_part_maps:
    input:
        networks=rules.evaluate_roles.input.networks,
        surfaces=expand(rules.prepare_object.output.surface, object=config["objects"]["names"]),
        properties=expand(rules.prepare_object.output.properties, object=config["objects"]["names"]),
    output:
        table="reports/part_contact_maps.csv",
    params:
        params=dict(config),
        kinds=kinds_of(),
        network=hashes(str(NETWORK)),
        code=script_hash("compare_part_maps"),
    message:
        "Comparing contact maps of found parts with those of true parts"
    script:
        "../scripts/compare_part_maps.py"


# For those who have scans: GRASPTYPES_REFERENCE_MESHES. The roles of a scan are those of our own model of the object.
rule evaluate_roles_on_scans:
    input:
        network=rules.train_role_network.output.network,
    output:
        table="reports/scan_roles.csv",
    params:
        settings=settings("segmentation"),
        scale=config["objects"]["scale"],
        resolution=config["objects"]["resolution"],
        scans=REFERENCE_MESHES,
        hashes=hashes(REFERENCE_MESHES),
        code=script_hash("evaluate_roles_on_scans"),
    message:
        "Testing the network that names roles on scans"
    script:
        "../scripts/evaluate_roles_on_scans.py"


SCANS = planned_scans()


rule plan_scan:
    output:
        table="data/segmentation/plans/{scan}.csv",
    wildcard_constraints:
        scan="|".join(SCANS) or "none",
    params:
        params=dict(config),
        file=lambda wildcards: SCANS[wildcards.scan][0],
        mesh=lambda wildcards: hashes(SCANS[wildcards.scan][0]),
        scale=lambda wildcards: SCANS[wildcards.scan][1],
        mass_kg=lambda wildcards: SCANS[wildcards.scan][2],
        slices=YCB_ROLES,
        roles=hashes(YCB_ROLES),
        hand=hand_parameter(config["hand"]),
        code=script_hash("plan_scan"),
    message:
        "Planning with and without parts: {wildcards.scan}"
    script:
        "../scripts/plan_scan.py"


rule tabulate_scan_plans:
    input:
        tables=expand(rules.plan_scan.output.table, scan=SCANS),
    output:
        table="reports/part_plans.csv",
        summary="reports/part_plan_gains.csv",
    params:
        code=script_hash("tabulate_scan_plans"),
    message:
        "Tabulating plans with and without parts"
    script:
        "../scripts/tabulate_scan_plans.py"


# Twenty objects that none of the kinds was measured on. GRASPTYPES_YCB names a checkout of elpis-lab/YCB_Dataset.
rule inspect_ycb:
    output:
        table="reports/ycb_parts.csv",
        sheet="reports/ycb_parts.png",
    params:
        folder=real_objects(os.environ)["ycb"],
        names=[
            *("power_drill", "pitcher_base", "spatula", "bleach_cleanser", "hammer", "knife"),
            *("phillips_screwdriver", "scissors", "mug", "skillet_lid", "spoon", "banana"),
            *("mustard_bottle", "adjustable_wrench", "large_clamp", "bowl", "plate"),
            *("padlock", "tomato_soup_can", "windex_bottle"),
        ],
        params=dict(config),
        network=hashes(str(NETWORK)),
        code=script_hash("inspect_ycb"),
    message:
        "Inspecting YCB objects"
    script:
        "../scripts/inspect_ycb.py"
