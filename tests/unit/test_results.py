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
