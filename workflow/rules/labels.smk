# Grasp types by rule, the dataset, and how both compare with the published ones.


rule evaluate_labels:
    input:
        published=published_data("GRASPTYPES_PUBLISHED_CSV"),
        references=published_data("GRASPTYPES_REFERENCE_MESHES", ".stl"),
        # Models of our own stand in for the scans that were never published.
        own=expand("data/objects/{object}/surface.npz", object=OBJECTS),
    output:
        table="reports/label_agreement.csv",
        validation="reports/label_cross_validation.csv",
        figure="reports/figures/label_confusion.png",
    log:
        "logs/evaluate_labels.log",
    benchmark:
        "logs/benchmarks/evaluate_labels.tsv"
    params:
        settings=settings("grasp_types"),
        scale=config["replay"]["object_scale"],
        own="data/objects",
        code=script_hash("evaluate_labels"),
    message:
        "Comparing the rule's labels with the people's"
    script:
        "../scripts/evaluate_labels.py"
