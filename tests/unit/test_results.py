"""What README and docs quote is what docs/results holds, and git holds no other results."""

import re
import subprocess
from pathlib import Path

import pandas as pd
import pytest
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.hold_fit import free_parameters
from grasptypes.settings.holds import read_hold_table

ROOT = Path(__file__).parents[2]
RESULTS = ROOT / "docs/results"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
LABELS = {"simulated": "table1.csv", "published": "table1_published.csv"}


def test_the_readmes_table_is_that_of_the_results() -> None:
    rows = re.findall(r"^\| ([a-z* ]+) \| (.+) \| (.+) \| (.*) \|$", PAGES[0].read_text(), re.M)
    shown = {name.strip("*"): cells for name, *cells in rows if "/" in cells[0]}
    measures = ("sim_mean", "acc_mean", "prec_mean")
    names = {
        "no_task": "without task",
        "task_vector": "task as a vector",
        "task_in_image": "task in the image",
        "ignores_task": "task ignored",
    }
    for column, file in enumerate(LABELS.values()):
        table = pd.read_csv(RESULTS / file).set_index("model")
        for model, name in names.items():
            row = table.loc[model]
            assert shown[name][column] == " / ".join(f"{row[key]:.3f}" for key in measures)
            paper = " / ".join(f"{row['paper_' + key.split('_')[0]]:.2f}" for key in measures)
            assert shown[name][2] == paper


SHOWN = {
    "known kinds, other images": "kinds_known",
    "held-out kinds": "kinds",
    "held-out kinds, the other task known": "kind_tasks",
    "held-out objects": "objects",
    "of these, the six that no number was fitted to": "objects_unfitted",
    "scans of held-out objects": "scans",
    "scans of known objects": "scans_known",
    "photographs of held-out objects and kinds": "photographs",
    "photographs of known ones": "photographs_known",
}
ANSWERED_BY = (
    "constant",
    "task_vector",
    "size_only",
    "geometry",
    "general",
    "general_size",
    "general_views_size",
)


def test_the_table_of_unseen_objects_is_that_of_the_results() -> None:
    page = (ROOT / "docs/general.md").read_text()
    table = pd.read_csv(RESULTS / "table3.csv").set_index(["shown", "labels", "model"]).sort_index()
    found = set()
    for name, source, *cells in re.findall(
        r"^\| ([^|]+)" + r" \| ([^|]+)" * 8 + r" \|$", page, re.M
    ):
        if name not in SHOWN:
            continue
        for model, cell in zip(ANSWERED_BY, cells, strict=True):
            key = (SHOWN[name], source, model)
            if key not in table.index:
                assert cell == "-"
                continue
            row = table.loc[key]
            error = "" if model == "constant" else f" ± {row.similarity_se:.3f}"
            assert cell == f"{row.similarity:.3f}{error}"
            found.add(key)
    assert found == {key for key in table.index if key[-1] in ANSWERED_BY}


def test_the_readme_quotes_table_3() -> None:
    text = " ".join(PAGES[0].read_text().split())
    table = pd.read_csv(RESULTS / "table3.csv").set_index(["shown", "labels", "model"]).sort_index()
    published = table.loc["objects", "published"]
    kinds = table.loc["kinds", "simulated", "general"].n_objects
    assert (
        f"`general` has learned from {kinds} of them, and is better than the constant by "
        f"{published.over_constant['general']:.2f} from an image, and by "
        f"{published.over_constant['general_size']:.2f} with the object's size" in text
    )
    assert (
        f"angular similarity of {published.similarity['general_size']:.3f} to the published "
        f"labels; a constant answer reaches {published.similarity['constant']:.3f}, and the "
        f"paper's model (b) {published.similarity['task_vector']:.3f}" in text
    )


def test_the_table_of_demonstrations_is_that_of_the_results() -> None:
    page = (ROOT / "docs/paper.md").read_text()
    shown = {"the image": "views", "also the object": "objects"}
    shown["also the action, such as striking"] = "actions"
    table = pd.read_csv(RESULTS / "demonstrations.csv", index_col=["labels", "split", "told"])
    rows = re.findall(r"^\| ([a-z, ]+) \| (0.+) \| (0.+) \| (0.+) \|$", page, re.M)
    assert [name for name, *_ in rows] == list(shown)
    for name, *cells in rows:
        for told, cell in zip(("right", "wrong", "none"), cells, strict=True):
            row = table.loc["published", shown[name], told]
            assert cell == f"{row.sim_mean:.3f} ± {row.sim_sd:.3f}"


def test_the_table_of_hands_is_that_of_the_results() -> None:
    page = (ROOT / "docs/own_hand.md").read_text()
    counts = pd.read_csv(RESULTS / "hands.csv").groupby("hand").sum(numeric_only=True)
    models = pd.read_csv(RESULTS / "hand_models.csv").set_index("hand")
    rows = re.findall(r"^\| `(\w+)` " + r"\| ([^|]*) " * 6 + r"\|$", page, re.M)
    assert {name for name, *_ in rows} == set(models.index)
    for name, valid, *failed, distance, ratio in rows:
        assert distance == f"{1e6 * models.pybullet_mm[name]:.0f} nm"
        assert ratio == f"{models.ratio[name]:.2f}"
        if name in counts.index:
            row = counts.loc[name]
            assert valid == f"{row.valid} of {row.grasps} ({100 * row.valid / row.grasps:.0f} %)"
            assert failed == [str(row[key]) for key in ("penetrates", "dropped", "joint_limit")]
    tables = pd.read_csv(RESULTS / "hand_tables.csv").set_index(["hand", "model"])
    for model in ("no_task", "task_vector", "task_in_image"):
        row = tables.loc["robotiq_3f", model]
        assert f"{row.sim_mean:.3f} / {row.acc_mean:.3f} / {row.prec_mean:.3f}" in page


TOLD_BY = {
    "(a) not told": "no_task",
    "(b) one-hot vector": "task_vector",
    "(c) colour shift": "task_in_image",
    "FiLM, embedding": "film",
    "Affordance vector": "affordance_vector",
    "FiLM, affordance vector": "film_affordance",
    "(f) demonstration": "demonstration",
    "Best constant answer": "constant",
    "Best answer to each object": "object_known",
}


def test_the_table_of_many_tasks_is_that_of_the_results() -> None:
    page = (ROOT / "docs/paper.md").read_text()
    keys = ["split", "model", "tasks", "evaluated"]
    table = pd.read_csv(RESULTS / "many_tasks.csv").set_index(keys).sort_index()
    columns = [("views", number, "all") for number in (2, 4, 8)]
    columns += [("views", 8, "differing"), ("tasks", 8, "all")]
    rows = {
        name: cells
        for name, *cells in re.findall(r"^\| ([^|]+)" + r" \| ([^|]+)" * 5 + r" \|$", page, re.M)
        if name in TOLD_BY
    }
    assert list(rows) == list(TOLD_BY)
    for name, cells in rows.items():
        for cell, (split, number, evaluated) in zip(cells, columns, strict=True):
            key = (split, TOLD_BY[name], number, evaluated)
            if key not in table.index:
                assert cell == "-"
                continue
            row = table.loc[key]
            error = "" if pd.isna(row.sim_se) else f" ± {row.sim_se:.3f}"
            assert cell == f"{row.sim_mean:.3f}{error}"


def test_results_are_quoted_and_the_others_are_not_in_git() -> None:
    quoted = "".join(page.read_text() for page in PAGES)
    assert [path.name for path in RESULTS.iterdir() if path.stem not in quoted] == []
    command = ["git", "ls-files", "data", "models", "reports"]
    tracked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert tracked.stdout == ""


def test_the_table_of_holds_has_the_fitted_numbers() -> None:
    fitted = pd.read_csv(RESULTS / "hold_parameters.csv").set_index("key").fitted
    parameters = free_parameters(read_hold_table(), PARAMS.hold_fit)
    in_table = {parameter.key: parameter.in_table for parameter in parameters}
    assert in_table == pytest.approx(fitted.to_dict(), abs=0.011)


def test_the_papers_page_shows_the_fine_tuned_runs_of_the_results() -> None:
    rows = pd.read_csv(RESULTS / "ablations.csv").query("changed == 'fine_tuned'")
    frozen, tuned = (rows[rows["value"] == value].set_index("model") for value in (0, 3))
    names = {
        "no_task": "a",
        "task_vector": "b",
        "task_in_image": "c",
        "ignores_task": "task ignored",
        "demonstration": "f",
        "e_mobilenet_v2": "e",
    }
    page = (ROOT / "docs/paper.md").read_text()
    assert set(tuned.index) == set(names)
    for model, name in names.items():
        cells = [t.loc[model, c] for c in ("sim_mean", "freq_mean") for t in (frozen, tuned)]
        assert f"\n  | {name} | {' | '.join(f'{cell:.3f}' for cell in cells)} |\n" in page
