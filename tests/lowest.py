"""Print the lowest versions of the library's dependencies, and what its tests need besides."""

import sys
import tomllib
from pathlib import Path

from packaging.requirements import Requirement

TESTS = ("hypothesis", "networkx", "packaging", "pytest", "rtree")


def lowest(requirement: Requirement) -> str:
    """The requirement with its lowest version."""
    version = next(each.version for each in requirement.specifier if each.operator in (">=", "=="))
    return f"{requirement.name}=={version}"


if __name__ == "__main__":
    project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text())["project"]
    pins = [lowest(Requirement(text)) for text in project["dependencies"]]
    sys.stdout.write("\n".join([*pins, *TESTS]) + "\n")
