"""A mesh with holes is rebuilt from few of the nodes of a grid, as if all were known."""

import igl
import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.objects import leaky_meshes
from grasptypes.objects.leaky_meshes import rebuilt
from grasptypes.objects.mesh_import import import_model
from grasptypes.settings.objects import OwnObject

LIMITS = PARAMS.objects.import_.changed(rebuild_cells=48)


def without_top(mesh, count):
    """A mesh without some of the faces that are highest."""
    order = np.argsort(mesh.triangles_center[:, 2], kind="stable")
    return trimesh.Trimesh(mesh.vertices, mesh.faces[order[:-count]])


def ball():
    return without_top(trimesh.creation.icosphere(subdivisions=3, radius=0.04), 50)


def thin_tube():
    """A tube whose wall is two cells thick, and which lacks a part of its upper end."""
    tube = trimesh.creation.annulus(0.037, 0.04, 0.05, sections=48)
    return without_top(tube.subdivide(), 20)


@pytest.mark.parametrize("mesh", [ball(), thin_tube()], ids=["ball", "thin tube"])
def test_few_nodes_give_the_surface_of_all(mesh, monkeypatch):
    asked, winding = [], igl.fast_winding_number

    def counting(vertices, faces, nodes):
        asked[-1] += len(nodes)
        return winding(vertices, faces, nodes)

    monkeypatch.setattr(igl, "fast_winding_number", counting)
    solids = []
    for stride in (leaky_meshes.STRIDE, 1):
        monkeypatch.setattr(leaky_meshes, "STRIDE", stride)
        asked.append(0)
        solids.append(rebuilt("mesh.stl", mesh, LIMITS)[0])
    few, all_of_them = solids
    assert few.volume() == pytest.approx(all_of_them.volume(), rel=1e-4)
    assert few.num_tri() == pytest.approx(all_of_them.num_tri(), rel=1e-3)
    assert asked[0] < 0.5 * asked[1]


def test_what_bulges_out_of_a_hole_is_cut(monkeypatch):
    tube = trimesh.creation.cylinder(0.02, 0.08, sections=48).subdivide().subdivide()
    top = tube.triangles_center[:, 2] > 0.0399
    open_tube = trimesh.Trimesh(tube.vertices, tube.faces[~top])
    solid, spacing_m = rebuilt("tube.stl", open_tube, LIMITS)
    assert solid.volume() == pytest.approx(tube.volume, rel=0.1)
    assert solid.bounding_box()[5] == pytest.approx(0.04, abs=spacing_m)
    # Many nodes are on its faces, where winding numbers are one half as in an open shell.
    monkeypatch.setattr(leaky_meshes, "ON_FACE", -1)
    with pytest.raises(InputError, match="open shell"):
        rebuilt("tube.stl", open_tube, LIMITS)


def test_the_width_of_cells_is_that_on_the_object(tmp_path):
    ball().export(tmp_path / "holed.stl")
    own = OwnObject(file=str(tmp_path / "holed.stl"), unit="m", density_kg_m3=1e3, scale=2.0)
    (repair,) = import_model(own, LIMITS).repairs
    assert repair == "closed holes by rebuilding the surface at 3.3 mm"


def test_a_surface_that_encloses_nothing_proper_is_an_input_error(monkeypatch):
    def refuse(*_):
        raise ValueError("not a closed oriented mesh")

    monkeypatch.setattr(leaky_meshes.solids, "from_mesh", refuse)
    with pytest.raises(InputError, match=r"cup\.stl: has holes, and its surface cannot be rebuilt"):
        rebuilt("cup.stl", ball(), LIMITS)


def test_long_faces_are_cut_without_changing_what_they_enclose():
    box = trimesh.creation.box((0.3, 0.02, 0.02))
    cut = leaky_meshes._bisected(np.asarray(box.triangles), 0.03)
    assert np.linalg.norm(np.roll(cut, 1, axis=1) - cut, axis=2).max() <= 0.03
    corners = np.cross(cut[:, 0], cut[:, 1])
    assert np.einsum("fi,fi->", corners, cut[:, 2]) / 6 == pytest.approx(box.volume)
    assert trimesh.triangles.area(cut).sum() == pytest.approx(box.area)
