"""Outlines of cuts: where they start, which way they run, how far along a point lies."""

import numpy as np
import pytest

from grasptypes.contact_maps.outline import along_outline, convex_outline


def _circle(radius_m, centre=(0.0, 0.0)):
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    return radius_m * np.column_stack([np.cos(angle), np.sin(angle)]) + centre


def test_runs_clockwise_from_above_the_centre():
    outline = convex_outline(_circle(0.04))
    points = 0.04 * np.array([[0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]])
    arc, distance, normal = along_outline(outline, points)
    quarter_m = np.pi / 2 * 0.04
    assert arc == pytest.approx([0.0, quarter_m, 2 * quarter_m, 3 * quarter_m], abs=1e-3)
    assert distance == pytest.approx(0.0, abs=6e-4)
    assert np.sum(normal * points, axis=1) == pytest.approx(0.04, rel=1e-3)


def test_spans_hollows():
    square = np.array([[-1, -1], [1, -1], [1, 1], [0.0, 0.2], [-1, 1]]) * 0.02
    edges = np.linspace(square, np.roll(square, -1, axis=0), 20).reshape(-1, 2)
    _, distance, _ = along_outline(convex_outline(edges), np.array([[0.0, 0.004]]))
    assert distance == pytest.approx([0.016], abs=1e-3)


def test_starts_above_the_cut_when_the_centre_lies_beside_it():
    outline = convex_outline(_circle(0.01, centre=(0.05, 0.0)))
    assert outline[0] == pytest.approx([0.05, 0.01], abs=1e-4)


@pytest.mark.parametrize("cut", [np.zeros((3, 2)), np.linspace([0, 0], [1, 0], 30)])
def test_too_thin_a_cut_has_none(cut):
    assert convex_outline(cut) is None
