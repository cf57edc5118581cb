"""Every branch of the tree and both sides of every threshold."""

import numpy as np
import pytest
from scipy.spatial.transform import RigidTransform
from tests.unit.barrett import BARRETT
from tests.unit.labels.cases import CONTACTS, THRESHOLDS, Ball
from tests.unit.settings import PARAMS

from grasptypes.hands.hand import PALM
from grasptypes.hands.states import HandStates
from grasptypes.labels.contacts import Contacts, find_contacts
from grasptypes.labels.grasp import Grasp, label
from grasptypes.labels.grasp_type import (
    TYPES,
    Measures,
    classify,
    enclosed_diameters,
    explain,
    fingertip_span,
    limits,
    measure,
    sideways_share,
)

# A wide medium wrap: every other type is one change away.
WRAP = {
    "palm_gap_m": 0.0,
    "enclosed_diameter_m": 0.070,
    "sideways_share": 0.0,
    "span_m": 0.060,
}


def labelled(**changes):
    measures = Measures(*(np.array([value]) for value in (WRAP | changes).values()))
    (found,) = explain(measures, THRESHOLDS)
    return found


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"span_m": 0.0801}, "Large Wrap"),
        ({"span_m": 0.080}, "Medium Wrap"),
        ({"enclosed_diameter_m": 0.050}, "Small Wrap"),
        ({"enclosed_diameter_m": 0.0501}, "Medium Wrap"),
        ({"sideways_share": 0.0501}, "Power Sphere"),
        ({"sideways_share": 0.05}, "Medium Wrap"),
        ({"palm_gap_m": 0.020}, "Medium Wrap"),
        ({"palm_gap_m": 0.0201}, "Precision"),
        ({"palm_gap_m": 0.0201, "sideways_share": 0.05}, "Precision"),
        ({"palm_gap_m": 0.0201, "sideways_share": 0.0501}, "Precision Sphere"),
        ({"enclosed_diameter_m": 0.04, "sideways_share": 0.5}, "Small Wrap"),
        ({"sideways_share": 0.5, "span_m": 0.2}, "Power Sphere"),
        ({"palm_gap_m": 0.1, "enclosed_diameter_m": 0.01}, "Precision"),
        ({"palm_gap_m": -0.004}, "Medium Wrap"),
    ],
)
def test_branch(changes, expected):
    found = labelled(**changes)
    assert found.grasp_type == expected
    assert found.virtual_fingers == (3 if expected.endswith("Sphere") else 2)


def test_classify_agrees_with_explain():
    draw = np.random.default_rng(0)
    measures = Measures(*(draw.uniform(0, 2, (4, 300)) * limits(THRESHOLDS)[:, None]))
    names = [TYPES[index] for index in classify(measures, limits(THRESHOLDS))]
    assert names == [one.grasp_type for one in explain(measures, THRESHOLDS)]
    assert set(names) == set(TYPES)


@pytest.mark.parametrize(
    ("changes", "branch"),
    [
        (
            {"enclosed_diameter_m": 0.050},
            "power: palm gap 0.0 mm <= 20.0 mm, enclosed diameter 50.0 mm <= 50.0 mm",
        ),
        (
            {"sideways_share": 0.06},
            "power: palm gap 0.0 mm <= 20.0 mm, enclosed diameter 70.0 mm > 50.0 mm, "
            "sideways share 0.060 > 0.050",
        ),
        (
            {},
            "power: palm gap 0.0 mm <= 20.0 mm, enclosed diameter 70.0 mm > 50.0 mm, "
            "sideways share 0.000 <= 0.050, fingertip span 60.0 mm <= 80.0 mm",
        ),
        (
            {"span_m": 0.0904},
            "power: palm gap 0.0 mm <= 20.0 mm, enclosed diameter 70.0 mm > 50.0 mm, "
            "sideways share 0.000 <= 0.050, fingertip span 90.4 mm > 80.0 mm",
        ),
        (
            {"palm_gap_m": 0.03},
            "precision: palm gap 30.0 mm > 20.0 mm, sideways share 0.000 <= 0.050",
        ),
        (
            {"palm_gap_m": 0.03, "sideways_share": 0.0504},
            "precision: palm gap 30.0 mm > 20.0 mm, sideways share 0.050 > 0.050",
        ),
    ],
)
def test_explanation_names_the_decisions_taken_and_no_others(changes, branch):
    assert labelled(**changes).branch == branch


@pytest.mark.parametrize(
    ("changes", "margin"),
    [
        ({"palm_gap_m": 0.016}, 0.2),
        ({"palm_gap_m": 0.019, "enclosed_diameter_m": 0.045}, 0.05),
        ({"enclosed_diameter_m": 0.045}, 0.1),
        ({"sideways_share": 0.06}, 0.2),
        ({"span_m": 0.072}, 0.1),
        ({"span_m": 0.088}, 0.1),
        ({"palm_gap_m": 0.03}, 0.5),
        ({"palm_gap_m": 0.03, "sideways_share": 0.055}, 0.1),
        # Neither the span is a branch of a sphere, nor the share one of a small wrap.
        ({"sideways_share": 0.06, "span_m": 0.08}, 0.2),
        ({"enclosed_diameter_m": 0.025, "sideways_share": 0.05}, 0.5),
        # Nor is the diameter or the span one of a precision grasp.
        ({"palm_gap_m": 0.03, "enclosed_diameter_m": 0.05, "span_m": 0.08}, 0.5),
    ],
)
def test_margin_is_the_share_to_the_nearest_threshold_that_mattered(changes, margin):
    assert labelled(**changes).margin == pytest.approx(margin)


def contacts(push=(0.0, -1.0, 0.0), weight=1.0):
    shape = (1, len(BARRETT.link_names))
    pushes = np.broadcast_to(np.array(push, dtype=float), (*shape, 3)).copy()
    weights = np.full(shape, weight)
    return Contacts(np.zeros(shape), np.zeros((*shape, 3)), -pushes, pushes, weights)


def test_sideways_share_is_the_mean_square_along_x():
    assert sideways_share(BARRETT, contacts())[0] == 0.0
    assert sideways_share(BARRETT, contacts([1.0, 0.0, 0.0]))[0] == pytest.approx(1.0)
    assert sideways_share(BARRETT, contacts([0.6, 0.8, 0.0]))[0] == pytest.approx(0.36)


def test_sideways_share_is_weighted_by_contact():
    some = contacts(weight=0.0)
    first, second = BARRETT.finger_links[:2]
    some.push[0, first], some.weight[0, first] = [1.0, 0.0, 0.0], 0.1
    some.push[0, second], some.weight[0, second] = [0.0, 1.0, 0.0], 0.3
    assert sideways_share(BARRETT, some)[0] == pytest.approx(0.25)


def test_sideways_share_without_contact_is_zero():
    assert sideways_share(BARRETT, contacts([1.0, 0.0, 0.0], weight=0.0))[0] == 0.0


def test_the_palm_does_not_count_as_a_finger():
    palm_only = contacts([1.0, 0.0, 0.0])
    palm_only.weight[:, 1:] = 0.0
    assert sideways_share(BARRETT, palm_only)[0] == 0.0


def test_span_goes_from_finger_3_to_the_further_opposing_one():
    some = contacts()
    some.position_m[0, list(BARRETT.tip_links)] = [[0, 0.03, 0], [0, 0.05, 0], [0, -0.02, 0]]
    assert fingertip_span(BARRETT, some)[0] == pytest.approx(0.07)
    some.position_m[0, list(BARRETT.tip_links)] = [[0.3, 0.4, 0], [0, 0.05, 0], [0, 0, 0]]
    assert fingertip_span(BARRETT, some)[0] == pytest.approx(0.5)


def test_enclosed_circle_touches_palm_and_both_links():
    angles = np.radians([[0, 0, 70, 70, 70, 25, 25, 25]])
    diameter = enclosed_diameters(BARRETT, angles)[0, 0]
    radius = diameter / 2 + 0.010
    base, tip = np.radians(70 + 5), np.radians(25 + 40)
    # In the finger's plane: the palm along -x from the base, the links as they turn from +x.
    joint = 0.070 * np.array([np.cos(base), np.sin(base)])
    end = joint + 0.055 * np.array([np.cos(base + tip), np.sin(base + tip)])
    centre = np.array([-radius * np.tan(base / 2), radius])
    for start, stop in (((0, 0), joint), (joint, end)):
        along = np.subtract(stop, start) / np.linalg.norm(np.subtract(stop, start))
        offset = centre - start
        away = abs(along[0] * offset[1] - along[1] * offset[0])
        assert away == pytest.approx(radius, abs=1e-9)


def test_measures_are_those_of_each_grasp_and_of_its_median_finger():
    angles = BARRETT.couple(np.radians([[0, 20, 90, 140], [40, 60, 50, 60]]))
    hands = HandStates(BARRETT, np.tile(np.eye(4), (2, 1, 1)), angles)
    field = Ball(0.04, (0.01, 0.0, 0.07))
    contacts = find_contacts(field, hands, CONTACTS)
    found = measure(field, hands, CONTACTS)
    np.testing.assert_allclose(found.palm_gap_m, contacts.gap_m[:, PALM])
    np.testing.assert_allclose(found.sideways_share, sideways_share(BARRETT, contacts))
    np.testing.assert_allclose(found.span_m, fingertip_span(BARRETT, contacts))
    middle = np.sort(enclosed_diameters(BARRETT, angles), axis=1)[:, 1]
    np.testing.assert_allclose(found.enclosed_diameter_m, middle)


def test_nothing_is_enclosed_by_fingers_that_cross_the_palm():
    closed = BARRETT.couple(np.radians([[0, 140, 140, 140]]))
    assert (enclosed_diameters(BARRETT, closed) >= 0).all()
    assert enclosed_diameters(BARRETT, np.full((1, 8), np.radians(150)))[0].tolist() == [0.0] * 3


class Jar:
    """An object that is a ball."""

    distance_grid = Ball(0.04, (0.0, 0.0, 0.041))


@pytest.mark.parametrize(("back_m", "branch"), [(0.0, "power: palm gap 1"), (0.05, "precision")])
def test_a_single_grasp_is_labelled_in_the_frame_of_its_object(back_m, branch):
    angles = BARRETT.couple(np.radians([60, 90, 90, 85]))
    settings = PARAMS.grasp_types.model_copy(update={"thresholds": THRESHOLDS})
    pose = RigidTransform.from_translation([0.0, 0.0, -back_m])
    assert label(
        Grasp(Jar(), "use", BARRETT, pose, angles, "", "", 0.0), settings
    ).branch.startswith(branch)
