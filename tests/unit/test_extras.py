"""Extras: the core works without them, and a missing one is named in a line."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import trimesh
from PIL import Image

from grasptypes.extras import EXTRAS, MissingExtraError, missing_extra

ROOT = Path(__file__).parents[2]
# What the package and its tests import by another name than that of the distribution.
DISTRIBUTIONS = {"sklearn": "scikit-learn", "pyrender": "pyrender2"}
HIDE = """
import importlib.util, sys
class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {names!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Hidden())
found = importlib.util.find_spec
def find_spec(name, package=None):
    return None if name.split(".")[0] in {names!r} else found(name, package)
importlib.util.find_spec = find_spec  # torch asks whether others are installed
"""
# Scripts of the main job and its reports that only read tables, by their first word.
LIGHT = ("analyse", "compare", "plot", "summarise", "tabulate")
# Single jobs of studies beside the main job.
STUDIES = {
    "analyse_general",
    "compare_plans",
    "plot_learning_curve",
    "tabulate_demonstrations",
    "tabulate_general",
    "tabulate_generalisation",
    "tabulate_scan_plans",
}
OPTIONAL = sorted({module for modules in EXTRAS.values() for module in modules})


def without(modules: list[str], code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run Python in which some modules are not installed."""
    code = HIDE.format(names=set(modules)) + code
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=folder
    )


def command(*words: str) -> str:
    return f"from grasptypes.__main__ import main; main({list(words)!r})"


def test_every_module_of_an_extra_is_a_requirement_of_it() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for extra, modules in EXTRAS.items():
        stated = " ".join(project["optional-dependencies"][extra])
        for module in modules:
            name = DISTRIBUTIONS.get(module, module).replace("_", "-")
            assert f"{name}=" in stated or f"{name}>" in stated, (extra, module)


def test_tables_and_figures_import_no_network_and_no_store() -> None:
    """They are many jobs, and each import would cost every one of them seconds."""
    folder = ROOT / "workflow" / "scripts"
    names = [path.stem for path in folder.glob("*.py") if path.stem.split("_")[0] in LIGHT]
    names = sorted({*names, "label_grasps", "label_published", "split_folds"} - STUDIES)
    assert len(names) > 15
    result = without(["torch", "mlflow", "pybullet"], f"import {', '.join(names)}", folder)
    assert result.returncode == 0, result.stderr


def test_the_core_needs_no_extra(tmp_path: Path) -> None:
    code = """
import grasptypes
from grasptypes.labels.dataset import dataset_schema
grasptypes.label, grasptypes.load_object, grasptypes.GRASP_TYPES, grasptypes.Grasp
"""
    trimesh.creation.cylinder(0.03, 0.1).export(tmp_path / "can.stl")
    page = command("inspect", "can.stl", "--task", "use", "--page", "can.html")
    for what in (code, command("hand", "check", "allegro"), page):
        done = without(OPTIONAL, what, tmp_path)
        assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("words", "extra"),
    [
        (("plan", "--object", "x.stl", "--task", "use", "--type", "Precision"), "plan"),
        (("predict", "x.png", "--task", "use"), "predict"),
        (("hand", "check", "barrett", "--picture", "x.png"), "plan"),
    ],
)
def test_a_command_names_the_extra_that_it_lacks(
    words: tuple[str, ...], extra: str, tmp_path: Path
) -> None:
    Image.new("RGB", (64, 64), "red").save(tmp_path / "x.png")
    done = without(OPTIONAL, command(*words), tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert done.stderr.endswith(f"pip install 'grasptypes[{extra}]'\n")


def test_prediction_from_a_photograph_needs_little_else(tmp_path: Path) -> None:
    Image.new("RGB", (64, 64), "red").save(tmp_path / "photo.png")
    others = sorted(set(OPTIONAL) - set(EXTRAS["predict"]))
    # What takes long to import, and photographs need not.
    others += ["torchvision", "matplotlib", "pandas", "trimesh"]
    words = ("predict", "photo.png", "--task", "use")
    done = without(others, command(*words), tmp_path)
    assert "general" in done.stdout, done.stderr


def test_help_imports_no_library(tmp_path: Path) -> None:
    done = without(["numpy", "pydantic", "yaml"], command("--help"), tmp_path)
    assert done.returncode == 0, done.stderr


def test_the_workflow_starts_without_the_libraries_of_its_jobs() -> None:
    """Snakemake reads the rules at every start, however little is left to do."""
    rules = [ROOT / "Snakefile", *(ROOT / "workflow" / "rules").glob("*.smk")]
    text = "\n".join(path.read_text() for path in rules)
    modules = sorted(set(re.findall(r"^from (grasptypes\S*) import", text, re.MULTILINE)))
    assert len(modules) > 15
    heavy = ["torch", "mlflow", "pybullet", "pandas", "scipy", "trimesh", "matplotlib"]
    done = without(heavy, f"import {', '.join(modules)}", ROOT)
    assert done.returncode == 0, done.stderr


def test_the_library_names_the_extra_that_it_lacks(tmp_path: Path) -> None:
    code = "import grasptypes\ngrasptypes.Predictor"
    done = without(OPTIONAL, code, tmp_path)
    assert "pip install 'grasptypes[predict]'" in done.stderr.splitlines()[-1]


def test_another_failed_import_is_a_bug() -> None:
    with pytest.raises(ModuleNotFoundError, match="gone"):
        missing_extra(ModuleNotFoundError("gone", name="grasptypes.gone"))
    assert isinstance(missing_extra(ModuleNotFoundError(name="torch.nn")), MissingExtraError)
