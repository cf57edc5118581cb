"""What is inside a mesh: cavities, parts in cavities, and surfaces turned the wrong way."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects.bodies import closed_bodies
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.preparation import physical_properties, prepare
from grasptypes.settings.objects import OwnObject

LIMITS = PARAMS.objects.import_.changed(rebuild_cells=48)
OUT, IN = 1, -1


def shell(radius_m, side, centre_m=(0, 0, 0)):
    """A sphere whose surface faces out or in."""
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=radius_m)
    mesh.apply_translation(centre_m)
    if side == IN:
        mesh.invert()
    return mesh


def volume(radius_m):
    """Volume of a sphere of triangles."""
    return shell(radius_m, OUT).volume


def imported(path, **keywords):
    own = OwnObject(file=str(path), density_kg_m3=1000.0, unit="m", **keywords)
    return import_model(own, LIMITS)


def mass_of(found):
    return physical_properties("thing", found).mass_kg


WALL = volume(0.04) - volume(0.037)
JOINED, TURNED = ("joined 2 bodies",), ("turned faces outwards",)
BALLS = {
    "a hollow ball": ([(4, OUT), (3.7, IN)], WALL, ()),
    "inside out": ([(4, IN), (3.7, OUT)], WALL, TURNED),
    "a part in a part": ([(4, OUT), (2, OUT)], volume(0.04), JOINED),
    "a part in a cavity": ([(4, OUT), (3.7, IN), (1, OUT)], WALL + volume(0.01), JOINED),
    "a hollow part in a cavity": (
        [(2.7, IN), (4, OUT), (3, OUT), (3.7, IN)],
        WALL + volume(0.03) - volume(0.027),
        JOINED,
    ),
    "a cavity in a cavity": ([(4, OUT), (3.7, IN), (2, IN)], WALL, ()),
    "a cavity in two parts": ([(4, OUT), (3, OUT), (2, IN)], volume(0.04), JOINED),
}


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply"])
@pytest.mark.parametrize("name", BALLS)
def test_material_is_where_the_surfaces_enclose_it(tmp_path, suffix, name):
    shells, expected, repairs = BALLS[name]
    path = tmp_path / f"ball.{suffix}"
    trimesh.util.concatenate([shell(cm / 100, side) for cm, side in shells]).export(path)
    found = imported(path)
    assert mass_of(found) == pytest.approx(1000 * expected, rel=1e-5)
    assert found.repairs == repairs
    # Hand and camera meet the outside alone.
    (part,) = found.model.parts
    assert part.solid.volume() == pytest.approx(volume(0.04), rel=1e-5)


def test_cavities_lie_beside_each_other_or_in_other_meshes(tmp_path):
    holes = [shell(0.01, IN, (x, 0, 0)) for x in (-0.02, 0.02)]
    trimesh.util.concatenate([shell(0.04, OUT), *holes]).export(tmp_path / "two.stl")
    expected = 1000 * (volume(0.04) - 2 * volume(0.01))
    assert mass_of(imported(tmp_path / "two.stl")) == pytest.approx(expected, rel=1e-5)
    scene = trimesh.Scene()
    scene.add_geometry(shell(0.04, OUT), geom_name="bottle", node_name="bottle")
    scene.add_geometry(shell(0.037, IN), geom_name="inside", node_name="inside")
    scene.export(tmp_path / "bottle.glb")
    found = imported(tmp_path / "bottle.glb")
    assert [part.name for part in found.model.parts] == ["bottle"]
    assert mass_of(found) == pytest.approx(1000 * WALL, rel=1e-5)


def test_material_that_reaches_into_a_cavity_stays(tmp_path):
    rod = trimesh.creation.box((0.06, 0.01, 0.01))
    rod.apply_translation((0.05, 0, 0))
    trimesh.util.concatenate([shell(0.04, OUT), shell(0.03, IN), rod]).export(tmp_path / "a.ply")
    hollow = 1000 * (volume(0.04) - volume(0.03))
    # 1 cm of the rod lies in the cavity, and 4 cm outside.
    assert mass_of(imported(tmp_path / "a.ply")) - hollow == pytest.approx(0.005, rel=0.02)


def test_a_bottle_that_is_open_has_no_cavity(tmp_path):
    profile = np.array([(0, 0), (2, 0), (2, 8), (1, 9), (0.8, 9), (1.8, 8), (1.8, 0.2), (0, 0.2)])
    bottle = trimesh.creation.revolve(profile / 100, sections=48)
    bottle.export(tmp_path / "bottle.stl")
    found = imported(tmp_path / "bottle.stl")
    assert found.model.cavities is None
    assert mass_of(found) == pytest.approx(1000 * abs(bottle.volume), rel=1e-5)


def test_the_inertia_is_that_of_the_walls_and_the_surface_that_of_the_outside(tmp_path):
    walls = trimesh.util.concatenate([shell(0.04, OUT), shell(0.037, IN)])
    walls.export(tmp_path / "ball.stl")
    found = imported(tmp_path / "ball.stl", scale=1.5)
    made = prepare("ball", found, PARAMS.objects.resolution, tmp_path / "ball")
    masses = [1000 * volume(0.06), -1000 * volume(0.0555)]
    expected = sum(0.4 * m * r**2 for m, r in zip(masses, (0.06, 0.0555), strict=True))
    assert np.diag(made.properties.inertia_kg_m2) == pytest.approx([expected] * 3, rel=0.01)
    assert made.properties.volume_m3 == pytest.approx(volume(0.06), rel=1e-5)
    assert np.linalg.norm(made.surface.vertices, axis=1).min() > 0.058
    assert made.distance_grid.distance(np.zeros((1, 3)))[0] < -0.01


def test_walls_are_not_counted_twice(tmp_path):
    trimesh.util.concatenate([shell(0.04, OUT), shell(0.03, IN)]).export(tmp_path / "a.stl")
    with pytest.raises(InputError, match="shell_thickness_m"):
        imported(tmp_path / "a.stl", shell_thickness_m=0.001)


def test_surfaces_that_a_file_cuts_are_joined_before_anything_is_filled(tmp_path):
    """A box with one solid a side, and one with one node a side."""
    box = trimesh.creation.box((0.05, 0.04, 0.03))
    sides = [trimesh.Trimesh(box.vertices, box.faces[box.facets[k]]) for k in range(6)]
    (tmp_path / "a.stl").write_text("".join(s.export(file_type="stl_ascii") for s in sides))
    scene = trimesh.Scene()
    for k, side in enumerate(sides):
        scene.add_geometry(side, geom_name=f"side{k}", node_name=f"side{k}")
    scene.export(tmp_path / "a.glb")
    joined = ("joined parts that are closed only together",)
    for name, repairs in {"a.stl": (), "a.glb": joined}.items():
        found = imported(tmp_path / name)
        assert found.repairs == repairs
        assert [part.name for part in found.model.parts] == ["body"]
        assert mass_of(found) == pytest.approx(0.06)


def test_a_few_faces_turned_the_wrong_way_do_not_fill_a_cavity(tmp_path):
    shells = [shell(0.04, OUT), shell(0.03, IN)]
    for mesh in shells:
        mesh.faces[:5] = mesh.faces[:5, ::-1]
    trimesh.util.concatenate(shells).export(tmp_path / "a.ply")
    found = imported(tmp_path / "a.ply")
    assert found.repairs == TURNED
    assert mass_of(found) == pytest.approx(1000 * (volume(0.04) - volume(0.03)), rel=1e-5)


def test_faces_that_face_anywhere_are_turned_outwards(tmp_path):
    mesh = shell(0.04, OUT)
    faces = mesh.faces.copy()
    some = np.random.default_rng(0).random(len(faces)) < 0.3
    faces[some] = faces[some][:, ::-1]
    repairs = []
    (body,) = closed_bodies({"ball": [trimesh.Trimesh(mesh.vertices, faces)]}, repairs)
    assert body.solid.volume() == pytest.approx(mesh.volume)
    assert not body.inward
    assert repairs == ["turned faces outwards"]


def test_what_stays_open_has_no_bodies():
    mesh = shell(0.04, OUT)
    faces = np.delete(mesh.faces, np.arange(5, 300, 7), axis=0)
    assert closed_bodies({"ball": [trimesh.Trimesh(mesh.vertices, faces[:-200])]}, []) is None


def test_loose_faces_are_not_made_bodies_of(monkeypatch):
    ball, made, submesh = shell(0.04, OUT), [], trimesh.Trimesh.submesh
    apart = ball.triangles + 1e-3 * np.arange(len(ball.faces))[:, None, None]
    faces = np.arange(3 * len(apart)).reshape(-1, 3)
    loose = trimesh.Trimesh(apart.reshape(-1, 3), faces, process=False)

    def counting(mesh, pieces, **keywords):
        made.append(len(pieces))
        return submesh(mesh, pieces, **keywords)

    monkeypatch.setattr(trimesh.Trimesh, "submesh", counting)
    assert closed_bodies({"body": [loose]}, []) is None
    assert set(made) == {1}
