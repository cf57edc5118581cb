"""DVC visits a stage when a parameter of its results changes."""

from pathlib import Path

import yaml

ROOT = Path(__file__).parents[3]
# Their results are no outputs of a stage with parameters: they belong to separate targets, to
# commands, or to the last two stages, which depend on the whole file.
ELSEWHERE = {
    "contact_pictures", "demonstrations", "general", "generalisation", "hold_fit", "kinds",
    "learning_curve", "many_tasks", "plan", "predict", "replay", "robustness", "tracking",
}  # fmt: skip


def test_every_section_of_the_parameters_belongs_to_a_stage() -> None:
    stages = yaml.safe_load((ROOT / "dvc.yaml").read_text())["stages"]
    named = {name for stage in stages.values() for name in stage.get("params", [])}
    sections = set(yaml.safe_load((ROOT / "params.yaml").read_text()))
    assert sections - named == ELSEWHERE
    assert named <= sections


def test_stages_without_parameters_depend_on_the_whole_file() -> None:
    stages = yaml.safe_load((ROOT / "dvc.yaml").read_text())["stages"]
    for name, stage in stages.items():
        assert "params" in stage or "params.yaml" in stage["deps"], name
