"""The hand's shapes: the stated sizes, closed, clear of each other, evenly covered by points."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from grasptypes.hand import kinematics, shapes
from grasptypes.hand.parts import convex_parts, outline, prism

LINK = {name: index for index, name in enumerate(kinematics.LINK_NAMES)}


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
    np.testing.assert_allclose(shapes.link_meshes()[LINK[link]].extents * 1e3, size_mm, atol=0.05)


def test_only_the_bracket_rises_above_the_palm() -> None:
    for part in convex_parts()[LINK["palm"]]:
        top = part.vertices_m[:, 2].max()
        assert top == pytest.approx(0.0128) if part.name == "bracket" else top <= 1e-9


def test_finger_ends_where_its_chain_ends() -> None:
    mesh = shapes.link_meshes()[LINK["distal_1"]]
    assert mesh.bounds[1, 0] == pytest.approx(kinematics.DISTAL_LENGTH_M)


def test_links_are_closed_and_pointing_outwards() -> None:
    for mesh in shapes.link_meshes():
        assert mesh.is_watertight
        assert mesh.volume > 0


def _overlap(a: str, b: str, angles: np.ndarray) -> np.ndarray:
    """Surface points of link b, in b's frame, that lie more than a micrometre inside link a."""
    poses = kinematics.link_poses(angles)
    T = np.linalg.inv(poses[LINK[a]]) @ poses[LINK[b]]
    surface = shapes.surface_points(0.003)
    points = surface.points_m[surface.link_index == LINK[b]]
    return points[shapes.depth_in_link(LINK[a], points @ T[:3, :3].T + T[:3, 3]) > 1e-6]


@pytest.mark.parametrize("spread_deg", [0, 45, 90, 180])
@pytest.mark.parametrize("finger_deg", [0, 60, 140])
def test_neighbouring_links_only_overlap_in_their_hubs(spread_deg: int, finger_deg: int) -> None:
    angles = kinematics.couple(np.radians([spread_deg, finger_deg, finger_deg, finger_deg]))
    for joint in kinematics.JOINTS:
        if joint.name.startswith("spread"):
            assert len(_overlap("palm", joint.child, angles)) == 0
            continue
        inside = _overlap(joint.parent, joint.child, angles)
        assert np.hypot(inside[:, 0], inside[:, 1]).max(initial=0.0) < 0.0145


@pytest.mark.parametrize("spread_deg", [0, 45, 90, 180])
def test_other_links_of_an_open_hand_are_apart(spread_deg: int) -> None:
    angles = kinematics.couple(np.radians([spread_deg, 40, 40, 40]))
    neighbours = {frozenset((joint.parent, joint.child)) for joint in kinematics.JOINTS}
    for a in kinematics.LINK_NAMES:
        for b in kinematics.LINK_NAMES:
            if a != b and frozenset((a, b)) not in neighbours:
                assert len(_overlap(a, b, angles)) == 0, (a, b)


@pytest.mark.parametrize("spread_deg", [0, 30, 60, 90, 180])
def test_inner_links_fold_to_their_limit_beside_the_palm(spread_deg: int) -> None:
    angles = kinematics.couple(np.radians([spread_deg, 140, 140, 140]))
    for link in ("proximal_1", "proximal_2"):
        assert len(_overlap("palm", link, angles)) == 0
        assert len(_overlap(link, "palm", angles)) == 0


def test_surface_points_lie_on_the_surface_with_outward_normals() -> None:
    surface = shapes.surface_points(0.006)
    for link in range(len(kinematics.LINK_NAMES)):
        mine = surface.link_index == link
        points, normals = surface.points_m[mine], surface.normals[mine]
        assert np.abs(shapes.depth_in_link(link, points)).max() < 1e-6
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
        assert shapes.inside_link(link, points - 1e-5 * normals).all()
        assert not shapes.inside_link(link, points + 1e-5 * normals).any()


def test_surface_points_are_even() -> None:
    spacing = 0.006
    surface = shapes.surface_points(spacing)
    for link in range(len(kinematics.LINK_NAMES)):
        points = surface.points_m[surface.link_index == link]
        nearest = cKDTree(points).query(points, k=2)[0][:, 1]
        assert nearest.min() >= spacing
        assert nearest.max() < 2 * spacing


def test_surface_points_repeat_and_fingers_share_them() -> None:
    first = shapes.surface_points(0.008)
    shapes.surface_points.cache_clear()
    second = shapes.surface_points(0.008)
    np.testing.assert_array_equal(first.points_m, second.points_m)
    one, two = (first.points_m[first.link_index == LINK[f"distal_{i}"]] for i in (1, 2))
    np.testing.assert_array_equal(one, two)


def test_depth_is_that_of_the_nearest_face() -> None:
    finger = LINK["distal_1"]
    depth = shapes.depth_in_link(finger, np.array([[0.0, 0.0, 0.0], [0.056, 0.0, 0.0]]))
    np.testing.assert_allclose(depth, [0.010, -0.001], atol=3e-4)


def test_depth_in_the_hand_is_that_in_the_link_that_covers_a_point_most() -> None:
    poses = kinematics.link_poses(np.zeros(8))
    finger = LINK["distal_1"]
    in_finger = poses[finger, :3, 3].copy()
    outside = np.array([[0.0, 0.0, 0.5]])
    assert shapes.depth_in_hand(outside, poses) == 0.0
    deepest = shapes.depth_in_hand(np.vstack([outside, in_finger]), poses)
    assert deepest == pytest.approx(0.010, abs=3e-4)
    moved = np.array([0.0, 0.0, 1.0])
    poses[:, :3, 3] += moved
    assert shapes.depth_in_hand(np.vstack([outside, in_finger]) + moved, poses) == pytest.approx(
        deepest
    )


def test_prism_is_chamfered_and_keeps_its_outline() -> None:
    square = outline([[0, 0], [0.02, 0], [0.02, 0.01], [0, 0.01], [0.01, 0.005]])
    assert len(square) == 4
    corners = prism(square, -0.005, 0.005, edge=0.001)
    np.testing.assert_allclose(np.ptp(corners, axis=0), [0.02, 0.01, 0.01])
    end = corners[np.isclose(corners[:, 2], 0.005)]
    np.testing.assert_allclose(np.ptp(end, axis=0), [0.018, 0.008, 0.0])
