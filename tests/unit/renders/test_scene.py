"""Parts, viewpoints, colours and the shadow on the ground."""

import numpy as np
import pytest
import trimesh
from tests.unit.settings import PARAMS
from trimesh.visual.material import PBRMaterial

from grasptypes.errors import InputError
from grasptypes.renders.scene import ground_light, load_parts, recolour, surface_points, viewpoints
from grasptypes.seeds import rng
from grasptypes.settings.renders import Light

# The light shines straight onto the ground.
SUN = Light(intensity_lux=3.0, direction=(0.0, -np.cos(0.8), -np.sin(0.8)))
SETTINGS = PARAMS.renders.changed(
    **{"size_px": 64, "field_of_view_rad": 0.6, "fill": 0.8, "min_distance_radii": 2.6},
    **{"ground_elevation_rad": 0.8, "shadow_softness_px": 3.0, "shadow_strength": 0.5},
    **{"shadow_fading": 1.0, "lights": (SUN,)},
)
STEEL = PBRMaterial(baseColorFactor=[102, 102, 102, 255], metallicFactor=1.0, roughnessFactor=0.2)
WOOD = PBRMaterial(baseColorFactor=[204, 153, 51, 255], metallicFactor=0.0, roughnessFactor=0.8)


@pytest.fixture
def glb(tmp_path):
    """A bar of two materials, one of them on two meshes, one of those moved by its node."""
    scene = trimesh.Scene()
    for number, (material, x) in enumerate([(STEEL, 0.0), (WOOD, 0.1), (STEEL, 0.2)]):
        box = trimesh.creation.box((0.1, 0.02, 0.04))
        box.visual = trimesh.visual.TextureVisuals(material=material)
        pose = trimesh.transformations.translation_matrix((x, 0, 0))
        scene.add_geometry(box, geom_name=f"part_{number}", transform=pose)
    path = tmp_path / "visual.glb"
    path.write_bytes(scene.export(file_type="glb"))
    return path


def test_parts_are_grouped_by_material_and_put_in_place(glb):
    parts = load_parts(glb)
    assert [(p.metallic, p.roughness, len(p.faces)) for p in parts] == [(1, 0.2, 24), (0, 0.8, 12)]
    np.testing.assert_allclose(parts[1].base_colour, [0.8, 0.6, 0.2])
    whole = np.concatenate([p.vertices for p in parts])
    np.testing.assert_allclose(
        [whole.min(0), whole.max(0)], [[-0.05, -0.01, -0.02], [0.25, 0.01, 0.02]], atol=1e-7
    )


@pytest.mark.parametrize("content", [None, b"", b"not a mesh", b"glTF\x02\x00\x00\x00"])
def test_what_is_not_a_mesh_is_refused(tmp_path, content):
    path = tmp_path / "visual.glb"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=r"visual\.glb"):
        load_parts(path)


def test_viewpoints_frame_the_object_and_surround_it():
    vertices = trimesh.creation.box((0.2, 0.02, 0.04)).vertices + [0.3, 0.0, 0.1]
    poses = viewpoints(vertices, 400, SETTINGS, rng("test"))
    in_camera = np.einsum("vni,nij->nvj", vertices[:, None] - poses[:, :3, 3], poses[:, :3, :3])
    reach = np.abs(in_camera[..., :2] / in_camera[..., 2:]).max(axis=(1, 2)) / np.tan(0.3)
    assert (in_camera[..., 2] < 0).all()  # in front of the camera
    assert reach.max() == pytest.approx(0.8)
    assert (reach > 0.75).mean() > 0.7  # the others are held back by the smallest distance
    ways = poses[:, :3, 2]
    assert np.abs(ways.mean(axis=0)).max() < 0.1  # uniform: no side is preferred
    np.testing.assert_allclose(np.cov(ways.T), np.eye(3) / 3, atol=0.06)
    roll = np.arctan2(poses[:, 2, 0], poses[:, 2, 1])
    assert np.histogram(roll, 4, (-np.pi, np.pi))[0].min() > 70


def test_surface_points_are_spread_by_area(glb):
    points = surface_points(load_parts(glb), 6000, rng("test"))
    assert points.shape == (6000, 3)
    assert (points[:, 0] > 0.1).mean() == pytest.approx(0.5, abs=0.03)
    on_face = np.isclose(np.abs(points[:, 1]), 0.01) | np.isclose(np.abs(points[:, 2]), 0.02)
    # The six ends of the three boxes have 0.0048 of 0.0408 m^2.
    assert on_face.mean() == pytest.approx(1 - 48 / 408, abs=0.02)


def test_recolouring_keeps_the_luminance(glb):
    weights = np.array([0.2126, 0.7152, 0.0722])
    parts = load_parts(glb)
    for amount in (0.0, 0.5, 1.0):
        colours = [p.base_colour for p in recolour(parts, amount, rng("test", amount))]
        for colour, part in zip(colours, parts, strict=True):
            assert weights @ colour == pytest.approx(weights @ part.base_colour)
            assert (colour >= 0).all()
            assert (colour <= 1 + 1e-12).all()
            moved = np.abs(colour - part.base_colour).max()
            assert (moved > 0.01) == (amount > 0)


def test_the_shadow_lies_below_the_object_and_not_beside_it():
    ball = trimesh.creation.icosphere(2, 0.05).vertices
    pose = np.eye(4)
    pose[2, 3] = 0.5
    light = ground_light(ball, pose, SETTINGS)
    assert light.shape == (64, 64)
    assert light.dtype == np.float32
    assert light.min() >= 0.5 - 1e-6
    assert light.min() < 0.65
    assert light[0, 0] == pytest.approx(1.0, abs=0.01)
    row, column = np.unravel_index(light.argmin(), light.shape)
    assert abs(column - 32) <= 6
    assert row > 32  # below the middle of the image, where the ball stands
