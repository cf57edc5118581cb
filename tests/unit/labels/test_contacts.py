"""Contacts of hands with bodies whose distance is known in closed form."""

import numpy as np
import pytest
import trimesh
from tests.unit.barrett import BARRETT
from tests.unit.labels.cases import CONTACTS, Ball

from grasptypes.hands.hand import PALM
from grasptypes.hands.states import HandStates
from grasptypes.hands.surface import surface_points
from grasptypes.labels.contacts import (
    MeshDistance,
    closing_directions,
    find_contacts,
    unit,
)
from grasptypes.objects.distance_grid import DistanceGrid

UPRIGHT = np.eye(3)
SETTINGS = CONTACTS.model_copy(update={"surface_spacing_m": 0.006})


def pose(shift=(0.0, 0.0, 0.0), turn=UPRIGHT):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = turn, shift
    return T


def closed(spread=0.0, fingers=60.0):
    return BARRETT.couple(np.radians([[spread, fingers, fingers, fingers]]))


def hands(T_object_hand, spread=0.0, fingers=60.0):
    return HandStates(BARRETT, T_object_hand[None], closed(spread, fingers))


def test_palm_gap_is_the_distance_to_the_palm_plate():
    contacts = find_contacts(Ball(0.04, [0, 0, 0.06]), hands(pose()), SETTINGS)
    assert contacts.gap_m[0, PALM] == pytest.approx(0.02, abs=5e-4)
    np.testing.assert_allclose(contacts.normal[0, PALM], [0, 0, -1], atol=0.05)


def test_contacts_do_not_depend_on_where_the_object_frame_is():
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    shift = np.array([0.3, -0.2, 0.1])
    centre = np.array([0.01, 0.0, 0.07])
    here = find_contacts(Ball(0.05, centre), hands(pose(), 20), SETTINGS)
    there = find_contacts(Ball(0.05, turn @ centre + shift), hands(pose(shift, turn), 20), SETTINGS)
    for first, second in zip(here, there, strict=True):
        np.testing.assert_allclose(first, second, atol=1e-12)


def test_a_ball_is_pushed_from_both_sides_along_y_at_spread_zero():
    contacts = find_contacts(Ball(0.05, [0, 0, 0.09]), hands(pose()), SETTINGS)
    first, _, third = contacts.push[0, list(BARRETT.tip_links), 1]
    assert first < -0.5
    assert third > 0.5


def test_weight_falls_from_one_at_touch_to_zero_at_the_reach():
    contacts = find_contacts(Ball(0.02, [0, 0, 0.09]), hands(pose(), 0, 30), SETTINGS)
    expected = np.clip(1 - contacts.gap_m / SETTINGS.reach_m, 0, 1)
    np.testing.assert_allclose(contacts.weight, expected)
    assert contacts.weight.min() == 0.0
    deep = find_contacts(Ball(0.05, [0, 0, 0.0]), hands(pose(), 0, 30), SETTINGS)
    assert deep.weight[0, PALM] == 1.0


def test_closing_directions_are_the_motion_of_closing_fingers():
    angles, step = np.radians([[30.0, 50.0, 60.0, 70.0]]), 1e-6
    before, after = (BARRETT.couple(angles + [[0, s, s, s]]) for s in (0.0, step))
    # A point of the proximal link, where the fingertip's own turn plays no part.
    link = BARRETT.link_names.index("proximal_2")
    T = BARRETT.link_poses(before)
    position = T[:, :, :3, 3] + 0.05 * T[:, :, :3, 0]
    moved = BARRETT.link_poses(after)[:, link, :3, :] @ [0.05, 0, 0, 1.0]
    motion = (moved - position[:, link])[0]
    direction = closing_directions(BARRETT, T, position)[0, link]
    np.testing.assert_allclose(direction, motion / np.linalg.norm(motion), atol=1e-5)


def test_palm_and_knuckles_do_not_close():
    T = BARRETT.link_poses(closed())
    directions = closing_directions(BARRETT, T, T[:, :, :3, 3] + 0.01)
    others = [link for link in range(9) if link not in BARRETT.finger_links]
    assert not directions[:, others].any()


def test_mesh_and_grid_tell_the_same_contacts():
    box = trimesh.creation.box([0.05, 0.06, 0.12])
    box.apply_translation([0, 0, 0.075])
    vertices, faces = np.array(box.vertices), np.array(box.faces, dtype=np.int64)
    fields = MeshDistance(vertices, faces), DistanceGrid.from_mesh(vertices, faces, 0.003, 0.03)
    exact, sampled = (find_contacts(f, hands(pose()), SETTINGS) for f in fields)
    np.testing.assert_allclose(exact.gap_m[0, [PALM]], sampled.gap_m[0, [PALM]], atol=1e-3)
    near = exact.weight > 0.2
    assert near.sum() >= 3
    assert (np.sum(exact.push * sampled.push, axis=2)[near] > 0.95).all()


def test_mesh_distance_is_negative_inside_and_points_outwards():
    box = trimesh.creation.box([0.1, 0.1, 0.1])
    field = MeshDistance(np.array(box.vertices), np.array(box.faces, dtype=np.int64))
    distance, direction = field.distance_and_gradient([[0, 0, 0.04], [0, 0, 0.05], [0, 0, 0.07]])
    np.testing.assert_allclose(distance, [-0.01, 0.0, 0.02], atol=1e-9)
    np.testing.assert_allclose(direction, [[0, 0, 1]] * 3, atol=1e-9)


def test_mesh_distance_near_the_surface_points_along_the_face_whatever_the_shape_asked_for():
    box = trimesh.creation.box([0.1, 0.1, 0.1])
    vertices, faces = np.array(box.vertices), np.array(box.faces, dtype=np.int64)
    points = np.array(
        [
            [[0.06, 0.08, 0.0], [0.0502, 0.0, 0.0]],
            [[0.0, -0.0495, 0.0], [-0.051, 0.0, 0.0]],
        ]
    )
    expected = [[[0.316228, 0.948683, 0], [1, 0, 0]], [[0, -1, 0], [-1, 0, 0]]]
    distance, direction = MeshDistance(vertices, faces).distance_and_gradient(points)
    np.testing.assert_allclose(distance, [[0.0316228, 0.0002], [-0.0005, 0.001]], atol=1e-7)
    np.testing.assert_allclose(direction, expected, atol=1e-6)
    # Faces turned inside out change the normals, not what is inside.
    turned = MeshDistance(vertices, faces[:, ::-1]).distance_and_gradient(points)
    np.testing.assert_allclose(turned[0], distance, atol=1e-7)
    np.testing.assert_allclose(turned[1][0, 0], direction[0, 0], atol=1e-6)


def test_unit_vectors_keep_their_direction_and_zero_stays_zero():
    vectors = np.array([[[3.0, 4.0, 0.0], [0.0, 0.0, 0.0]], [[0.0, 1e-9, 0.0], [0.0, 0.0, -0.5]]])
    expected = [[[0.6, 0.8, 0.0], [0.0, 0.0, 0.0]], [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]]
    np.testing.assert_allclose(unit(vectors), expected)


@pytest.mark.parametrize("finger", [1, 2, 3])
def test_both_links_of_a_finger_turn_about_its_base(finger):
    T = BARRETT.link_poses(BARRETT.couple(np.radians([[40.0, 30.0, 50.0, 70.0]])))
    positions = np.random.default_rng(finger).normal(0, 0.1, (1, 9, 3))
    directions = closing_directions(BARRETT, T, positions)
    base = T[0, BARRETT.link_names.index(f"proximal_{finger}")]
    for kind in ("proximal", "distal"):
        link = BARRETT.link_names.index(f"{kind}_{finger}")
        moved = np.cross(base[:3, 2], positions[0, link] - base[:3, 3])
        np.testing.assert_allclose(directions[0, link], moved / np.linalg.norm(moved))


def test_contacts_are_the_weighted_means_of_the_points_near_each_link():
    centre, radius = np.array([0.02, -0.01, 0.1]), 0.045
    T = np.stack([pose(), pose([0.005, 0.01, -0.02])])
    angles = np.concatenate([closed(10, 50), closed(30, 70)])
    found = find_contacts(Ball(radius, centre), HandStates(BARRETT, T, angles), SETTINGS)
    surface = surface_points(BARRETT, SETTINGS.surface_spacing_m)
    for n, T_object_hand in enumerate(T):
        T_hand_link = BARRETT.link_poses(angles[n])
        closing = closing_directions(BARRETT, T_hand_link[None], found.position_m[n][None])[0]
        for link, T_link in enumerate(T_hand_link):
            points = surface.points_m[surface.link_index == link] @ T_link[:3, :3].T + T_link[:3, 3]
            offset = points + T_object_hand[:3, 3] - centre
            length = np.linalg.norm(offset, axis=1)
            gap = (length - radius).min()
            outward = offset / length[:, None]
            share = np.exp(-(length - radius - gap) / SETTINGS.patch_depth_m)
            share /= share.sum()
            assert found.gap_m[n, link] == pytest.approx(gap)
            on_object = points - (length - radius)[:, None] * outward
            np.testing.assert_allclose(found.position_m[n, link], share @ on_object, atol=1e-12)
            normal = unit(share @ outward)
            np.testing.assert_allclose(found.normal[n, link], normal, atol=1e-9)
            push = unit(SETTINGS.closing_weight * closing[link] - normal)
            np.testing.assert_allclose(found.push[n, link], push, atol=1e-9)
            weight = min(max(1 - gap / SETTINGS.reach_m, 0), 1)
            assert found.weight[n, link] == pytest.approx(weight)
