# Grasp types by rule, the dataset, and the comparison of both with the published ones.


rule evaluate_labels:
    input:
        published=PUBLISHED_CSV,
        references=REFERENCE_MESHES,
        # Our own models are used if there is no scan.
        own=expand("data/objects/{object}/surface.npz", object=without_scan()),
    output:
        table=report(
            "reports/label_agreement.csv",
            caption="../report/label_agreement.rst",
            category="Grasp types",
            labels={"subject": "agreement with people", "kind": "table"},
        ),
        validation="reports/label_cross_validation.csv",
        figure=report(
            "reports/label_confusion.png",
            caption="../report/label_agreement.rst",
            category="Grasp types",
            labels={"subject": "agreement with people", "kind": "figure"},
        ),
    params:
        hand=hand_parameter(config["published"]["hand"]),
        settings=settings("grasp_types"),
        relatives=config["hold_fit"]["relatives"],
        data=lambda wildcards: measuring_hashes(),
        scale=config["replay"]["object_scale"],
        code=script_hash("evaluate_labels"),
    message:
        "Comparing the rule's labels with human labels"
    script:
        "../scripts/evaluate_labels.py"


rule label_grasps:
    input:
        grasps=expand("data/grasps/{object}/{task}.parquet", object=OBJECTS, task=TASKS),
        grids=expand("data/objects/{object}/distance_grid.npz", object=OBJECTS),
    output:
        grasps="data/grasps.csv",
        samples="data/samples.csv",
    params:
        hand=hand_parameter(config["hand"]),
        settings=settings("grasp_types", "fitted_on", "softness", "own_frames"),
        # A dataset in which nothing holds an object for a task is a mistake.
        least=0,
        code=script_hash("label_grasps"),
    message:
        "Labelling all grasps"
    script:
        "../scripts/label_grasps.py"


rule compare_distribution:
    input:
        samples=rules.label_grasps.output.samples,
        published=PUBLISHED_COUNTS,
    output:
        table=report(
            "reports/distribution.csv",
            caption="../report/distribution.rst",
            category="Grasp types",
            labels={"subject": "distribution", "kind": "table"},
        ),
        figure=report(
            "reports/figures/distribution.png",
            caption="../report/distribution.rst",
            category="Grasp types",
            labels={"subject": "distribution", "kind": "figure"},
        ),
    params:
        published=hashes("assets/published_labels.csv"),
        code=script_hash("compare_distribution"),
    message:
        "Comparing the grasp types with the published counts"
    script:
        "../scripts/compare_distribution.py"


# Not part of any other target: its numbers are in src/grasptypes/settings/holds.yaml.
rule fit_holds:
    input:
        surfaces=expand(rules.prepare_object.output.surface, object=KNOWN["published"].objects),
        properties=expand(rules.prepare_object.output.properties, object=KNOWN["published"].objects),
        published=PUBLISHED_COUNTS,
    output:
        similarity="reports/hold_similarity.csv",
        parameters="reports/hold_parameters.csv",
    params:
        tasks=KNOWN["published"].tasks,
        fitted_on=FITTED_ON,
        settings=settings("hold_fit"),
        contact_maps=settings("contact_maps"),
        grasp_types=settings("grasp_types"),
        knowledge=hashes(KNOWLEDGE),
        published=hashes("assets/published_labels.csv"),
        seed=config["seed"],
        code=script_hash("fit_holds"),
    message:
        "Fitting the table of holds to published labels"
    script:
        "../scripts/fit_holds.py"


rule plot_label_tree:
    input:
        dataset=rules.label_grasps.output.grasps,
        pictures=expand("data/screenshots/{object}.zip", object=OBJECTS),
    output:
        figure=report(
            "reports/figures/label_tree.png",
            caption="../report/label_tree.rst",
            category="Grasp types",
            labels={"subject": "label tree", "kind": "figure"},
        ),
    params:
        hand=hand_parameter(config["hand"]),
        objects=OBJECTS,
        settings=settings("grasp_types", "fitted_on", "softness", "own_frames"),
        code=script_hash("plot_label_tree"),
    message:
        "Drawing the tree of grasp types"
    script:
        "../scripts/plot_label_tree.py"
