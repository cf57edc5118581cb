"""Lofts keep the object's axes, sections their size, stations their values."""

import numpy as np
import pytest

from grasptypes.kinds import lofts


@pytest.mark.parametrize(("axis", "size"), [("x", (5, 1, 2)), ("y", (1, 5, 2)), ("z", (1, 2, 5))])
def test_outlines_keep_the_axes_of_the_object(axis: str, size: tuple[float, ...]) -> None:
    outline = np.array([(0, 0), (1, 0), (1, 2), (0, 2)])
    solid = lofts.loft_along(axis, [0, 5], [outline, outline])
    assert solid.bounding_box() == (0, 0, 0, *size)
    assert solid.volume() == pytest.approx(10)


def test_stations_are_met_and_not_overshot() -> None:
    table = [(0.0, 1.0, 5.0), (1.0, 2.0, 5.0), (3.0, 2.0, 0.0)]
    at, values = lofts.interpolate_stations(table, count=31)
    assert (at[0], at[-1]) == (0.0, 3.0)
    np.testing.assert_allclose(values[[0, -1]], [(1, 5), (2, 0)])
    assert values[:, 0].max() <= 2.0
    assert np.diff(at)[0] < np.diff(at)[15] / 4


def test_superellipse_points_are_evenly_spread() -> None:
    outline = lofts.even_superellipse(3.0, 1.0, exponent=6.0, samples=60)
    steps = np.linalg.norm(np.diff(outline, axis=0), axis=1)
    assert steps.max() < 1.15 * np.median(steps)
    np.testing.assert_allclose(np.abs(outline).max(axis=0), [3.0, 1.0], rtol=1e-3)


def test_crowned_section_bulges_between_bottom_and_top() -> None:
    outline = lofts.crowned_section(
        2.0, -1.0, 3.0, exponent=8.0, top_crown_m=0.5, bottom_crown_m=0.2
    )
    assert outline[:, 1].max() == pytest.approx(3.0, abs=0.01)
    assert outline[:, 1].min() == pytest.approx(-1.0, abs=0.01)
    near_side = outline[np.abs(outline[:, 0]) > 1.7]
    assert near_side[:, 1].max() < 2.7
    x, y = outline.T
    assert np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0
