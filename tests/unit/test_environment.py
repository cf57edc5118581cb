"""The three statements of what is installed must agree: ranges, lock file, conda environment."""

import re
import tomllib
from pathlib import Path

import yaml
from packaging.requirements import Requirement
from packaging.version import Version

ROOT = Path(__file__).parents[2]
UNLOCKED = ("docs", "onnx", "points")


def locked() -> dict[str, Version]:
    lines = (ROOT / "requirements.lock").read_text().splitlines()
    pins = [re.match(r"([A-Za-z0-9._-]+)==(\S+)", line) for line in lines]
    return {pin[1].lower(): Version(pin[2]) for pin in pins if pin}


def stated(*extras: str) -> list[Requirement]:
    """The package's requirements with some extras, and the extras that these name."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    groups = [project["dependencies"], *(project["optional-dependencies"][name] for name in extras)]
    found = [Requirement(text) for group in groups for text in group]
    more = {extra for each in found if each.name == "grasptypes" for extra in each.extras}
    if more - set(extras):
        return stated(*extras, *sorted(more - set(extras)))
    return [each for each in found if each.name != "grasptypes"]


def extras() -> list[str]:
    """All but the tools of the site, which `make docs` installs, and those of two file formats."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return [name for name in project["optional-dependencies"] if name not in UNLOCKED]


def test_the_lock_pins_every_stated_package_within_its_range() -> None:
    pins = locked()
    for requirement in stated(*extras()):
        name = requirement.name.lower()
        assert name in pins, f"{name} is not locked: make lock"
        assert pins[name] in requirement.specifier, f"{name} {pins[name]} is out of its range"


def test_the_conda_environment_names_the_locked_versions() -> None:
    environment = yaml.safe_load((ROOT / "workflow/envs/grasptypes.yaml").read_text())
    pip = next(item["pip"] for item in environment["dependencies"] if isinstance(item, dict))
    pins = locked()
    requirements = [Requirement(text) for text in pip]
    for requirement in requirements:
        assert str(requirement.specifier) == f"=={pins[requirement.name.lower()]}"
    needed = {requirement.name.lower() for requirement in stated("workflow")}
    assert {requirement.name.lower() for requirement in requirements} == needed
