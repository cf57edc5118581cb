# Does choosing grasp types first help? Not part of the main job: snakemake -j2 reports/planning.csv
from types import SimpleNamespace

ASKED = SimpleNamespace(labels=config["predict"]["labels"])


rule compare_plans:
    input:
        inputs=lambda wildcards: learning_inputs(ASKED),
        samples=SAMPLES[ASKED.labels],
        folds=rules.split_folds.output.folds,
        backbone=rules.prepare_backbone.output.record,
        objects=lambda wildcards: expand(
            rules.prepare_object.output, object=KNOWN[ASKED.labels].objects
        ),
    output:
        table=report(
            "reports/planning.csv",
            caption="../report/planning.rst",
            category="Grasps",
            labels={"subject": "types chosen first", "kind": "table"},
        ),
        markdown="reports/planning.md",
    threads: 2
    params:
        params=dict(config),
        tasks=lambda wildcards: learning_tasks(ASKED),
        hand=hand_parameter(config["hand"]),
        code=script_hash("compare_plans"),
    message:
        "Planning with and without choosing types first"
    script:
        "../scripts/compare_plans.py"
