# What choosing grasp types first buys; not part of the main job: snakemake -j2 reports/planning.csv


rule compare_plans:
    input:
        inputs=LEARNING_INPUTS,
        samples=SAMPLES[config["predict"]["labels"]],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
        objects=expand(rules.prepare_object.output.properties, object=OBJECTS),
        hand="assets/barrett_hand/barrett_hand.urdf",
    output:
        table="reports/planning.csv",
        markdown="reports/planning.md",
    log:
        "logs/compare_plans.log",
    benchmark:
        "logs/benchmarks/compare_plans.tsv"
    conda:
        "../envs/grasptypes.yaml"
    threads: 2
    params:
        params={
            key: config[key]
            for key in (
                "seed",
                "tasks",
                "contact_maps",
                "synthesis",
                "physics",
                "grasp_types",
                "predictors",
                "predict",
                "plan",
            )
        },
        hand=folder_hash("assets/barrett_hand"),
        code=script_hash("compare_plans"),
    message:
        "Planning with types chosen first and without"
    script:
        "../scripts/compare_plans.py"
