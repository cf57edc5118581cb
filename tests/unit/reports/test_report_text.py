"""The first page of the report links to the sections that it has, and to no others."""

import re
from pathlib import Path
from types import SimpleNamespace

import jinja2
import pytest

TEXT = Path(__file__).parents[3] / "workflow/report/workflow.rst"
SECTIONS = ["Objects", "Grasps", "Grasp types", "Results", "Unseen objects", "Folds", "Timing"]


@pytest.mark.parametrize("sections", [SECTIONS, SECTIONS[:-1], ["Results"], []])
def test_sections_that_are_not_there_are_not_linked(sections):
    text = jinja2.Template(TEXT.read_text(encoding="utf-8")).render(
        categories=[SimpleNamespace(name=name) for name in sections],
        snakemake=SimpleNamespace(config={"objects": {"names": ["mug"]}}),
    )
    assert re.findall(r"^- `(.+)`_: .", text, re.MULTILINE) == sections
