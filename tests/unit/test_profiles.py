"""What a cluster needs to know of the rules: where each runs, what it needs, and with whom."""

import re
from pathlib import Path

import pandas as pd
import yaml

ROOT = Path(__file__).parents[2]
DEFAULT = yaml.safe_load((ROOT / "profiles/default/profile.yaml").read_text())


def rules_with_jobs() -> set[str]:
    """Rules that run a script, also by way of another's."""
    text = "".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))
    blocks = re.findall(r"^rule (\w+):\n((?:\n|    .*\n)*)", text, re.MULTILINE)
    names = {name for name, block in blocks if "\n    script:" in block}
    return names | set(re.findall(r"^use rule \w+ as (\w+)", text, re.MULTILINE))


def local_rules() -> set[str]:
    block = re.search(
        r"^localrules:\n((?:    .*\n)*)", (ROOT / "Snakefile").read_text(), re.MULTILINE
    )
    assert block is not None
    return set(re.findall(r"\w+", block[1]))


def test_every_rule_runs_beside_snakemake_or_states_what_it_needs() -> None:
    stated = DEFAULT["set-resources"]
    missing = rules_with_jobs() - stated.keys() - local_rules()
    assert not missing, f"profiles/default/profile.yaml or localrules must name {missing}"
    assert stated.keys() | local_rules() <= rules_with_jobs()
    assert not stated.keys() & local_rules()
    for needs in stated.values():
        assert needs.keys() == {"mem_mb", "runtime"}


def test_groups_hold_rules_that_are_submitted() -> None:
    assert DEFAULT["groups"].keys() <= DEFAULT["set-resources"].keys()
    assert set(DEFAULT["groups"].values()) == DEFAULT["group-components"].keys()


def test_jobs_are_promised_half_more_than_the_most_they_took() -> None:
    """On a cluster the promise is a limit."""
    measured = pd.read_csv(ROOT / "docs/results/benchmarks.csv", index_col="name")["value"]
    peaks_mib = measured.filter(like="peak memory of ")
    promised_mb = {rule: needs["mem_mb"] for rule, needs in DEFAULT["set-resources"].items()}
    known = {name.removeprefix("peak memory of "): value for name, value in peaks_mib.items()}
    assert {"synthesize_grasps", "compare_plans"} <= known.keys()
    tight = {rule for rule in known if promised_mb.get(rule, 1e9) < 1.5 * 1.05 * known[rule]}
    assert not tight
