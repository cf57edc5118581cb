"""The public API: what `import grasptypes` gives, what it costs, and what the README shows."""

import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
import trimesh
from learning import ROOT, SMALL_PLANS, small_checkout

import grasptypes
from grasptypes.predictors.weights import WEIGHTS_VARIABLE


def snippet(page):
    """The first Python code that a page shows."""
    return re.search(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)[1]


def run(code, **more):
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, **more
    )


def test_every_name_is_there_and_others_are_not():
    for name in grasptypes.__all__:
        assert getattr(grasptypes, name) is not None
    assert set(grasptypes.__all__) <= set(dir(grasptypes))
    assert grasptypes.__version__ == version("grasptypes")
    assert (Path(grasptypes.__file__).with_name("py.typed")).is_file()
    with pytest.raises(AttributeError, match="no attribute 'planner_of_nothing'"):
        _ = grasptypes.planner_of_nothing


def test_the_import_loads_no_library():
    heavy = ["numpy", "pandas", "scipy", "torch", "trimesh", "numba", "pydantic", "matplotlib"]
    done = run(f"import sys, grasptypes; print([n for n in {heavy} if n in sys.modules])")
    assert done.stdout == "[]\n", done.stderr


@pytest.mark.parametrize(
    "page",
    ["README.md", pytest.param("docs/quick_start_package.md", marks=pytest.mark.slow)],
)
def test_the_code_of_a_page_runs(page, tmp_path):
    weights = small_checkout(tmp_path, SMALL_PLANS)
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    trimesh.creation.cylinder(0.03, 0.12, sections=48).export(tmp_path / "mug.stl")
    environment = {WEIGHTS_VARIABLE: str(weights.path)}
    pin = "from grasptypes.runtime import pin_runtime; pin_runtime()\n"
    shown = snippet(page)
    assert len(shown.splitlines()) <= 10
    code = f"{pin}import os; os.environ |= {environment}\n{shown}"
    done = run(code, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert any(kind in done.stdout for kind in grasptypes.GRASP_TYPES)
    assert (tmp_path / "mug_grasps/plan.json").is_file() == ("plan.write" in shown)


def test_what_has_drawn_can_still_predict():
    """Mesa and torch's compiler each bring an LLVM; torch's must not come second."""
    code = """
import grasptypes
grasptypes.Planner
from grasptypes.renders.renderer import Camera
from tests.unit.settings import PARAMS
with Camera(PARAMS.renders):
    import torch._dynamo
print("alive")
"""
    assert run(code, cwd=ROOT).stdout.endswith("alive\n")


def test_a_grasp_carries_its_pose_and_can_be_labelled_again(tmp_path):
    small_checkout(tmp_path, SMALL_PLANS)
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    planner = grasptypes.Planner(tmp_path)
    trimesh.creation.cylinder(0.03, 0.12, sections=48).export(tmp_path / "can.stl")
    can = grasptypes.load_object(tmp_path / "can.stl", settings=planner.params.objects)
    plan = planner.plan(can, "use", ["power_sphere"])
    assert [grasp.object for grasp in plan.grasps] == [can] * 3
    for grasp, shape in zip(plan.grasps, plan.ranking["shape"], strict=True):
        label = grasptypes.label(grasp, planner.params.grasp_types)
        assert label.grasp_type == shape
        assert grasp.grasp_type == (shape if grasp.reason == "valid" else "Invalid")
        rotation = grasp.T_object_hand.rotation.as_matrix()
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
        assert grasp.joint_positions.shape == (8,)
    for wrong in (("fly", []), ("use", ["Hug"])):
        with pytest.raises(grasptypes.InputError, match="unknown; allowed"):
            planner.plan(can, *wrong)
