"""A plan for one mesh: the sessions, the order of the grasps, the files, and what is rejected."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import trimesh
from learning import ROOT, SMALL_PLANS, small_checkout
from PIL import Image
from tests.unit.barrett import BARRETT

from grasptypes.__main__ import main
from grasptypes.commands.plan import TYPES
from grasptypes.contact_maps.contact_map import MapTask, draw_session
from grasptypes.contact_maps.hold import Hold
from grasptypes.contact_maps.measured_contacts import draw_measured_session
from grasptypes.errors import InputError
from grasptypes.exchange import dexgraspbench, graspit_world, multigrippergrasp
from grasptypes.hands.reading import load_hand
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.labels.published import read_published
from grasptypes.objects.loading import load_object
from grasptypes.planning import plan_contacts as plan_contacts_module
from grasptypes.planning.plan_contacts import (
    MeasuredMap,
    grips_of,
    hold_parts,
    missing_types,
    plan_contacts,
)
from grasptypes.planning.planner import Planner
from grasptypes.planning.sessions import choose, ranked
from grasptypes.predictors.weights import WEIGHTS_VARIABLE
from grasptypes.settings.params import read_params
from grasptypes.viewer.grasp_views import load_views

SESSIONS = SMALL_PLANS["plan"]["sessions"]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    root = tmp_path_factory.mktemp("checkout")
    small_checkout(root, SMALL_PLANS)
    (root / "assets").symlink_to(ROOT / "assets")
    return root


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    """A bottle-like cylinder in millimetres, and a map that is warm around its upper half."""
    folder = tmp_path_factory.mktemp("mesh")
    tube = trimesh.creation.cylinder(30, 160, sections=48)
    tube.export(folder / "tube.stl")
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(tube.vertices, tube.faces, 4))
    warm = np.where(np.abs(fine.vertices[:, 2] - 40) < 30, 250, 20)
    colours = np.column_stack([warm, warm, warm, np.full(len(warm), 255)]).astype(np.uint8)
    fine.visual = trimesh.visual.ColorVisuals(fine, vertex_colors=colours)
    fine.export(folder / "warm.ply")
    return folder / "tube.stl"


def plan(checkout, mesh, output, *more):
    asked = ["plan", "--folder", checkout, "--object", mesh, "--unit", "mm", "--output", output]
    main([str(word) for word in [*asked, *(more or ("--task", "use")), "--jobs", "1"]])


@pytest.fixture(scope="module")
def planned(checkout, mesh, tmp_path_factory):
    """Folder of a plan for a given type."""
    output = tmp_path_factory.mktemp("plan") / "new" / "grasps"
    plan(checkout, mesh, output, "--task", "use", "--type", "power_sphere")
    return output


def test_tables_can_be_read_as_the_published_one(planned):
    table = read_published(planned / "grasps.csv")
    assert len(table) == SESSIONS
    assert table["rank"].tolist() == [1, 2, 3]
    assert [numbers[0] for numbers in table.hand_configuration] == [0, 1, 2]
    assert sorted(table.session) == [1, 2, 3]
    ours = pd.read_csv(planned / "grasps.csv")
    assert ((ours.GraspType == "Invalid") == (ours.reason != "valid")).all()
    assert ours.branch.str.startswith(("power: ", "precision: ")).all()


def test_the_viewer_shows_parts_with_roles_contact_map_and_forces(planned):
    shown = load_views(str(planned), None, None)
    tube = shown.objects["tube"]
    parts = json.loads((planned / "plan.json").read_text())["parts"]["parts"]
    assert {part.name: part.role for part in tube.parts} == {
        part["part"]: part["role"] for part in parts
    }
    assert list(tube.maps) == ["use"]
    assert 0 <= tube.maps["use"].min() < tube.maps["use"].max() <= 1
    surface = trimesh.load_mesh(planned / "object" / "visual.glb")
    table = pd.read_csv(planned / "grasps.csv")
    for grasp, valid in zip(shown.grasps, table.reason == "valid", strict=True):
        assert (len(grasp.contacts.links) > 0) == valid
        if valid:
            assert np.linalg.norm(grasp.contacts.forces_n, axis=1).sum() > 1
            away = trimesh.proximity.closest_point(surface, grasp.contacts.points_m)[1]
            assert away.max() < 0.003


def test_every_try_has_a_reason(planned):
    grasps, attempts = (pd.read_csv(planned / f"{n}.csv") for n in ("grasps", "attempts"))
    assert len(attempts) == grasps.tries.sum()
    assert not attempts.reason.isna().any()
    assert sorted(attempts[attempts.chosen].session) == sorted(grasps.Session)
    held = attempts[attempts.reason == "valid"].session
    assert set(held) == set(grasps[grasps.reason == "valid"].Session)
    assert (attempts.hand_configuration.str.count(",") == 16).all()


def test_the_formats_of_the_field_hold_the_same_hands(planned):
    table = pd.read_csv(planned / "grasps.csv")
    valid = table[table.reason == "valid"]
    hands = multigrippergrasp.read_grasps(planned / "multigrippergrasp.json", BARRETT)
    assert len(valid) > 0
    assert len(hands.held) == len(valid)
    for number in range(len(valid)):
        name = f"grasp_{number + 1:02}"
        world = graspit_world.read_world(planned / f"graspit/{name}.xml", BARRETT)
        grasp = dexgraspbench.read_grasp(planned / f"dexgraspbench/{name}.npy", BARRETT)
        for other in (world, grasp):
            np.testing.assert_allclose(
                other.T_object_hand[0].as_matrix(),
                hands.T_object_hand[number].as_matrix(),
                atol=1e-6,
            )
    with Image.open(planned / "grasps.png") as picture:
        assert picture.width == 64 * min(2, len(valid))
    assert trimesh.load(planned / "object/visual.glb").extents.max() == pytest.approx(0.16)


def test_the_same_again_with_two_processes_and_as_json(planned, checkout, mesh, tmp_path, capsys):
    asked = ("--task", "use", "--type", "Power Sphere", "--json", "--jobs", "2")
    main(
        ["plan", "--folder", str(checkout), "--object", str(mesh), "--unit", "mm"]
        + ["--output", str(tmp_path / "again"), *asked]
    )
    shown = capsys.readouterr()
    assert shown.out == (planned / "plan.json").read_text()
    assert shown.err.count("session ") == SESSIONS
    for file in sorted(path for path in planned.rglob("*") if path.is_file()):
        assert (tmp_path / "again" / file.relative_to(planned)).read_bytes() == file.read_bytes()


def test_the_predictor_chooses_types_if_none_is_given(
    checkout, mesh, tmp_path, capsys, monkeypatch
):
    monkeypatch.setenv(WEIGHTS_VARIABLE, str(checkout / "random.pth"))
    monkeypatch.chdir(tmp_path)
    few = ("--task", "handoff", "--sessions", "1", "--contact-map", mesh.parent / "warm.ply")
    asked = ["plan", "--folder", checkout, "--object", mesh, "--unit", "mm", *few, "--jobs", "1"]
    main([*map(str, asked)])
    assert "(chosen by task_vector, simulated labels)" in capsys.readouterr().out
    said = json.loads((tmp_path / "tube_handoff_grasps/plan.json").read_text())
    (answer,) = said["chosen_by"]["answers"]
    chosen = {each["type"] for each in answer["types"] if each["chosen"]}
    assert set(said["wanted_types"]) == chosen
    assert said["contact_map"] == "warm.ply"


@pytest.mark.parametrize("known", [False, True])
def test_the_predictor_is_told_a_mass_that_is_known(checkout, mesh, known):
    told = []

    class Heard(Exception):
        """The predictor was asked."""

    def predict(*args, mass_kg, **kwargs):
        told.append(mass_kg)
        raise Heard

    planner = Planner(checkout)
    planner._predictor = SimpleNamespace(predict=predict)
    with pytest.raises(Heard):
        planner.plan(load_object(mesh, "mm", mass_kg=0.2), "use", mass_known=known)
    assert told == [pytest.approx(0.2) if known else None]


def map_task(checkout, mesh, sessions):
    params = read_params(checkout / "params.yaml")
    tube = load_object(mesh, "mm", mass_kg=0.1, settings=params.objects)
    settings = params.contact_maps.changed(sessions=sessions)
    return MapTask.of_object(tube, ("tube", "use"), 0, settings)


def test_wanted_grips_take_turns_where_it_is_warm(checkout, mesh):
    task = map_task(checkout, mesh, sessions=8)
    scan = MeasuredMap(mesh.parent / "warm.ply", 0.001)
    grips = grips_of(["Large Wrap", "Small Wrap", "Precision"])
    assert grips == ("wrap", "pinch")
    warm = plan_contacts(task, scan, grips, mesh).contact_map
    assert sorted(warm.grip) == ["pinch"] * 4 + ["wrap"] * 4
    anywhere = plan_contacts(task, None, grips, mesh).contact_map
    height = [(m.sessions * m.points[:, 2]).sum() / m.sessions.sum() for m in (warm, anywhere)]
    assert height[0] > 0.03 > abs(height[1])
    assert (anywhere.probability == 1).all()


@pytest.fixture
def unlucky(monkeypatch):
    """Numbers of sessions whose hand finds no place."""
    numbers = set()

    def draw(task, probability, number, *rest):
        return (
            None if number in numbers else draw_measured_session(task, probability, number, *rest)
        )

    def hold(task, holds, number):
        if number in numbers:
            raise InputError("tube", "", "nobody can hold it")
        return draw_session(task, holds, number)

    monkeypatch.setattr(plan_contacts_module, "draw_measured_session", draw)
    monkeypatch.setattr(plan_contacts_module, "draw_session", hold)
    return numbers


def test_a_session_without_a_place_is_left_out_and_the_others_stay(checkout, mesh, unlucky):
    asked = map_task(checkout, mesh, sessions=3), None, ("wrap",), mesh
    whole = plan_contacts(*asked)
    assert whole.numbers == (1, 2, 3)
    unlucky.add(2)
    rest = plan_contacts(*asked)
    assert rest.numbers == (1, 3)
    np.testing.assert_array_equal(rest.contact_map.sessions, whole.contact_map.sessions[[0, 2]])
    unlucky.update((1, 3))
    with pytest.raises(InputError, match=r"tube\.stl: no hand can hold it anywhere.*0\.16 m long"):
        plan_contacts(*asked)


def test_parts_are_held_with_the_wanted_grips_if_people_use_them(checkout, mesh):
    task = map_task(checkout, mesh, sessions=6)
    around, across = (
        Hold(("body",), (), grip, None, np.array([0.0, 0.0, 1.0]), 0.3, 0.7, share)
        for grip, share in (("wrap", 0.7), ("pinch", 0.3))
    )
    task = replace(task, part_names=["body"])
    both = hold_parts(task, [around, across], ("wrap", "pinch", "enclose"))
    assert set(both.contact_map.grip) == {"wrap", "pinch"}
    assert set(hold_parts(task, [around, across], ("pinch",)).contact_map.grip) == {"pinch"}
    assert set(hold_parts(task, [around], ("enclose",)).contact_map.grip) == {"wrap"}
    assert hold_parts(task, [], ("wrap",)) is None


def test_the_plan_without_a_session_keeps_the_others(
    planned, checkout, mesh, tmp_path, unlucky, capsys
):
    unlucky.add(2)
    plan(checkout, mesh, tmp_path / "out", "--task", "use", "--type", "power_sphere")
    assert f"skipped 1 of {SESSIONS} ways of holding" in capsys.readouterr().err
    all_tries, tries = (pd.read_csv(p / "attempts.csv") for p in (planned, tmp_path / "out"))
    kept = all_tries[all_tries.session != 2].reset_index(drop=True)
    pd.testing.assert_frame_equal(tries, kept)


def test_a_file_s_name_does_not_change_the_plan(planned, checkout, mesh, tmp_path):
    other = tmp_path / "my $cup$.stl"
    other.write_bytes(mesh.read_bytes())
    plan(checkout, other, tmp_path / "out", "--task", "use", "--type", "power_sphere")
    assert (tmp_path / "out/attempts.csv").read_text() == (planned / "attempts.csv").read_text()
    table = pd.read_csv(tmp_path / "out/grasps.csv")
    assert set(table.Object) == {"my $cup$"}


def test_wanted_types_come_first_and_failures_last():
    table = pd.DataFrame(
        {
            "grasp_type": ["Precision", "Invalid", "Small Wrap", "Small Wrap"],
            "valid": [True, False, True, True],
            "touches_avoided": False,
            "energy": [0.1, 0.0, 0.5, 0.4],
            "session": [1, 2, 3, 4],
            "rank": [0, 5, 1, 2],
            "hand_configuration": [[float(k), *[0.5] * 16] for k in (0, 5, 1, 2)],
        }
    )
    order = ranked(table, ["Small Wrap"])
    assert order.session.tolist() == [4, 3, 1, 2]
    assert order["rank"].tolist() == [0, 1, 2, 3]
    assert order.pose_index.tolist() == [2, 1, 0, 5]
    assert [numbers[0] for numbers in order.hand_configuration] == [0, 1, 2, 3]
    on_a_blade = table.assign(touches_avoided=[False, False, False, True])
    assert ranked(on_a_blade, ["Small Wrap"]).session.tolist() == [3, 1, 4, 2]


def test_a_session_gives_its_grasp_of_a_wanted_type():
    columns = ["session", "grasp_type", "valid", "chosen", "energy"]
    rows = [
        (1, "Precision", True, False, 0.1),
        (1, "Small Wrap", True, False, 0.3),
        (1, "Small Wrap", True, False, 0.2),
        (1, "Large Wrap", True, True, 0.4),
        (2, "Invalid", False, True, 0.5),
        (2, "Invalid", False, False, 0.4),
        (3, "Small Wrap", True, False, 0.1),
        (3, "Small Wrap", True, True, 0.9),
    ]
    attempts = pd.DataFrame(rows, columns=columns).assign(touches_avoided=False)
    for types, expected in (["Small Wrap"], [2, 4, 7]), (["Power Sphere"], [3, 4, 7]):
        chosen = choose(attempts, types).chosen
        assert np.flatnonzero(chosen).tolist() == expected
    attempts.loc[2, "touches_avoided"] = True
    assert np.flatnonzero(choose(attempts, ["Small Wrap"]).chosen).tolist() == [1, 4, 7]


def test_the_help_lists_all_types():
    assert ", ".join(GRASP_TYPES[:-1]) == TYPES


def test_all_types_have_a_grip():
    assert set(grips_of(GRASP_TYPES[:-1])) == {"wrap", "enclose", "tripod", "pinch"}


def test_a_gripper_reports_the_types_that_it_cannot_form_in_one_line(checkout, mesh, capsys):
    jaws = load_hand("franka_hand")
    assert missing_types(jaws) == ["Power Sphere", "Precision Sphere"]
    assert missing_types(BARRETT) == []
    lines: list[str] = []
    planner = Planner(checkout, hand="franka_hand", tell=lines.append)
    planner.plan(load_object(mesh, "mm"), "use", ["Power Sphere", "Precision"], sessions=1)
    assert "Franka Hand cannot form Power Sphere: other grips are tried" in lines
