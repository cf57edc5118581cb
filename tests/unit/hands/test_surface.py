"""The BarrettHand's links: their sizes, closed, clear of each other, evenly covered by points."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.unit.barrett import BARRETT, DISTAL_M, LINK

from grasptypes.hands.surface import (
    depth_in_hand,
    depth_in_link,
    inside_link,
    link_meshes,
    surface_points,
)


@pytest.mark.parametrize(
    ("link", "size_mm"),
    [
        ("palm", (89.0, 108.9, 95.7)),
        ("knuckle_1", (76.0, 25.0, 47.0)),
        ("proximal_2", (92.0, 27.0, 19.0)),
        ("distal_3", (67.5, 20.0, 23.0)),
    ],
)
def test_links_have_the_stated_size(link: str, size_mm: tuple[float, ...]) -> None:
    np.testing.assert_allclose(link_meshes(BARRETT)[LINK[link]].extents * 1e3, size_mm, atol=0.05)


def test_only_the_bracket_rises_above_the_palm() -> None:
    for part in BARRETT.links[LINK["palm"]].parts:
        top = part.vertices_m[:, 2].max()
        assert top == pytest.approx(0.0128) if part.name == "palm_bracket" else top <= 1e-9


def test_finger_ends_where_its_chain_ends() -> None:
    mesh = link_meshes(BARRETT)[LINK["distal_1"]]
    assert mesh.bounds[1, 0] == pytest.approx(DISTAL_M)


def test_links_are_closed_and_pointing_outwards() -> None:
    for mesh in link_meshes(BARRETT):
        assert mesh.is_watertight
        assert mesh.volume > 0


def _overlap(a: str, b: str, angles: np.ndarray) -> np.ndarray:
    """Surface points of link b, in b's frame, that lie more than a micrometre inside link a."""
    poses = BARRETT.link_poses(angles)
    T = np.linalg.inv(poses[LINK[a]]) @ poses[LINK[b]]
    surface = surface_points(BARRETT, 0.003)
    points = surface.points_m[surface.link_index == LINK[b]]
    return points[depth_in_link(BARRETT.links[LINK[a]], points @ T[:3, :3].T + T[:3, 3]) > 1e-6]


@pytest.mark.parametrize("spread_deg", [0, 45, 90, 180])
@pytest.mark.parametrize("finger_deg", [0, 60, 140])
def test_neighbouring_links_only_overlap_in_their_hubs(spread_deg: int, finger_deg: int) -> None:
    angles = BARRETT.couple(np.radians([spread_deg, finger_deg, finger_deg, finger_deg]))
    for joint, child in zip(BARRETT.joints, BARRETT.link_names[1:], strict=True):
        if joint.name.startswith("spread"):
            assert len(_overlap("palm", child, angles)) == 0
            continue
        inside = _overlap(BARRETT.link_names[joint.parent], child, angles)
        assert np.hypot(inside[:, 0], inside[:, 1]).max(initial=0.0) < 0.0145


@pytest.mark.parametrize("spread_deg", [0, 45, 90, 180])
def test_other_links_of_an_open_hand_are_apart(spread_deg: int) -> None:
    angles = BARRETT.couple(np.radians([spread_deg, 40, 40, 40]))
    names = BARRETT.link_names
    neighbours = {
        frozenset((names[joint.parent], child))
        for joint, child in zip(BARRETT.joints, names[1:], strict=True)
    }
    for a in names:
        for b in names:
            if a != b and frozenset((a, b)) not in neighbours:
                assert len(_overlap(a, b, angles)) == 0, (a, b)


@pytest.mark.parametrize("spread_deg", [0, 30, 60, 90, 180])
def test_inner_links_fold_to_their_limit_beside_the_palm(spread_deg: int) -> None:
    angles = BARRETT.couple(np.radians([spread_deg, 140, 140, 140]))
    for link in ("proximal_1", "proximal_2"):
        assert len(_overlap("palm", link, angles)) == 0
        assert len(_overlap(link, "palm", angles)) == 0


def test_surface_points_lie_on_the_surface_with_outward_normals() -> None:
    surface = surface_points(BARRETT, 0.006)
    for link in range(len(BARRETT.link_names)):
        mine = surface.link_index == link
        points, normals = surface.points_m[mine], surface.normals[mine]
        assert np.abs(depth_in_link(BARRETT.links[link], points)).max() < 1e-6
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
        assert inside_link(BARRETT.links[link], points - 1e-5 * normals).all()
        assert not inside_link(BARRETT.links[link], points + 1e-5 * normals).any()


def test_surface_points_are_even() -> None:
    spacing = 0.006
    surface = surface_points(BARRETT, spacing)
    for link in range(len(BARRETT.link_names)):
        points = surface.points_m[surface.link_index == link]
        nearest = cKDTree(points).query(points, k=2)[0][:, 1]
        assert nearest.min() >= spacing
        assert nearest.max() < 2 * spacing


def test_surface_points_repeat_and_fingers_share_them() -> None:
    first = surface_points(BARRETT, 0.008)
    surface_points.cache_clear()
    second = surface_points(BARRETT, 0.008)
    np.testing.assert_array_equal(first.points_m, second.points_m)
    one, two = (first.points_m[first.link_index == LINK[f"distal_{i}"]] for i in (1, 2))
    np.testing.assert_array_equal(one, two)


def test_depth_is_that_of_the_nearest_face() -> None:
    finger = LINK["distal_1"]
    depth = depth_in_link(BARRETT.links[finger], np.array([[0.0, 0.0, 0.0], [0.056, 0.0, 0.0]]))
    np.testing.assert_allclose(depth, [0.010, -0.001], atol=3e-4)


def test_depth_in_the_hand_is_that_in_the_link_that_covers_a_point_most() -> None:
    poses = BARRETT.link_poses(np.zeros(8))
    finger = LINK["distal_1"]
    in_finger = poses[finger, :3, 3].copy()
    outside = np.array([[0.0, 0.0, 0.5]])
    assert depth_in_hand(BARRETT, outside, poses) == 0.0
    deepest = depth_in_hand(BARRETT, np.vstack([outside, in_finger]), poses)
    assert deepest == pytest.approx(0.010, abs=3e-4)
    moved = np.array([0.0, 0.0, 1.0])
    poses[:, :3, 3] += moved
    assert depth_in_hand(BARRETT, np.vstack([outside, in_finger]) + moved, poses) == pytest.approx(
        deepest
    )
