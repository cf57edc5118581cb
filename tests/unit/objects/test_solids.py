"""The solids have the volumes, bounds and orientation that geometry asks of them."""

import numpy as np
import pytest

from grasptypes.kinds import sections
from grasptypes.objects import solids


def test_straight_sweep_is_a_prism():
    section = sections.superellipse(0.01, 0.02, samples=256)
    swept = solids.sweep([(0, 0, 0), (0.05, 0, 0), (0.1, 0, 0)], section)
    assert swept.volume() == pytest.approx(np.pi * 0.01 * 0.02 * 0.1, rel=1e-3)
    assert np.ptp(np.reshape(swept.bounding_box(), (2, 3)), axis=0) == pytest.approx(
        [0.1, 0.02, 0.04], rel=1e-3
    )


def test_open_mesh_is_refused():
    with pytest.raises(ValueError, match="closed"):
        solids.from_mesh(np.eye(3), [[0, 1, 2]])


def test_offset_curve_keeps_its_distance():
    quarter = sections.arc((0, 0), 0.05, 0, 90, 64)
    inner = sections.offset_curve(quarter, 0.002)
    assert np.linalg.norm(inner, axis=1) == pytest.approx(np.full(64, 0.048), abs=1e-5)


def test_smooth_curve_passes_its_control_points():
    control = np.array([(0.0, 0.0), (0.02, 0.05), (0.01, 0.1)])
    curve = sections.smooth_curve(control, 400)
    gaps = np.linalg.norm(curve[None] - control[:, None], axis=-1).min(axis=1)
    assert gaps.max() < 3e-4
