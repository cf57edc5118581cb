# Does choosing grasp types first help? Not part of the main job: snakemake -j2 reports/planning.csv
from types import SimpleNamespace

CHOSEN_BY_GENERAL = PARAMS.plan.comparison.model == "general"
ASKED = SimpleNamespace(labels=config["predict"]["labels"])


rule compare_plans:
    input:
        answers="data/general/answers.parquet" if CHOSEN_BY_GENERAL else [],
        inputs=lambda wildcards: [] if CHOSEN_BY_GENERAL else learning_inputs(ASKED),
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
