# Tables of results.


rule tabulate_simulated:
    input:
        metrics=expand(rules.train_predictor.output.metrics, labels="simulated", model=MODELS),
        samples=[SAMPLES["simulated"]],
    output:
        table=report(
            "reports/table1.csv",
            caption="../report/table1.rst",
            category="Results",
            labels={"subject": "Table I", "labels": "simulated", "kind": "table"},
        ),
        markdown="reports/table1.md",
        figure=report(
            "reports/figures/table1.png",
            caption="../report/table1.rst",
            category="Results",
            labels={"subject": "Table I", "labels": "simulated", "kind": "figure"},
        ),
    params:
        labels=["simulated"],
        unseen=False,
        code=script_hash("tabulate_results"),
    message:
        "Tabulating the models on simulated labels"
    script:
        "../scripts/tabulate_results.py"


use rule tabulate_simulated as tabulate_published with:
    input:
        metrics=expand(rules.train_predictor.output.metrics, labels="published", model=MODELS),
        samples=[SAMPLES["published"]],
    output:
        table=report(
            "reports/table1_published.csv",
            caption="../report/table1.rst",
            category="Results",
            labels={"subject": "Table I", "labels": "published", "kind": "table"},
        ),
        markdown="reports/table1_published.md",
        figure=report(
            "reports/figures/table1_published.png",
            caption="../report/table1.rst",
            category="Results",
            labels={"subject": "Table I", "labels": "published", "kind": "figure"},
        ),
    params:
        labels=["published"],
        unseen=False,
        code=script_hash("tabulate_results"),
    message:
        "Tabulating the models on published labels"


use rule tabulate_simulated as tabulate_unseen with:
    input:
        metrics=expand(rules.leave_out_objects.output.metrics, labels=LABELS, model=MODELS),
        samples=[SAMPLES[labels] for labels in LABELS],
    output:
        table=report(
            "reports/table2.csv",
            caption="../report/table2.rst",
            category="Unseen objects",
            labels={"subject": "Table II", "labels": "both", "kind": "table"},
        ),
        markdown="reports/table2.md",
        figure=report(
            "reports/figures/table2.png",
            caption="../report/table2.rst",
            category="Unseen objects",
            labels={"subject": "Table II", "labels": "both", "kind": "figure"},
        ),
    params:
        labels=LABELS,
        unseen=True,
        code=script_hash("tabulate_results"),
    message:
        "Tabulating the models on unseen objects"


# The tables of the enabled label sources.
TABLES = {
    "simulated": rules.tabulate_simulated.output,
    "published": rules.tabulate_published.output,
}
# Without any of the authors' objects there is nothing to compare with.
DISTRIBUTION = rules.compare_distribution.output if KNOWN["published"].objects else []


# Read by `dvc metrics show` and `dvc metrics diff`.
rule summarise_scores:
    input:
        known=[TABLES[labels].table for labels in LABELS],
        unseen=rules.tabulate_unseen.output.table if UNSEEN else [],
        grasps=rules.label_grasps.output.grasps,
        distribution=DISTRIBUTION and DISTRIBUTION.table,
    output:
        models=expand("reports/scores/{labels}/{model}.json", labels=LABELS, model=MODELS),
        grasps="reports/scores/grasps.json",
    params:
        hand=hand_parameter(config["hand"]),
        code=script_hash("summarise_scores"),
    message:
        "Summarising the results"
    script:
        "../scripts/summarise_scores.py"
