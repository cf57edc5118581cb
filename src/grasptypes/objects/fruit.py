"""Apple and banana; ContactDB has no mesh of them, so they have common market sizes."""

import numpy as np
from manifold3d import Manifold

from grasptypes.objects import sections, solids
from grasptypes.objects.parts import Size, Solids


def apple(size: Size) -> Solids:
    """The apple: flesh, stem and calyx."""
    radius_m, half_m = size.diameter_m / 2, size.height_m / 2
    curve = sections.smooth_curve(size.profile, 72) * [radius_m, half_m]
    profile = sections.chain([(0.0, curve[0, 1])], curve, [(0.0, curve[-1, 1])])

    def furrow(points: np.ndarray) -> np.ndarray:
        """Deepen the furrows between the lobes towards the bottom; points are (N, 3)."""
        angle = np.arctan2(points[:, 1], points[:, 0])
        low = np.clip(0.5 - points[:, 2] / size.height_m, 0, 1)
        factor = 1 - size.lobe_depth * low * (0.5 - 0.5 * np.cos(size.lobes * angle))
        return np.asarray(points * np.column_stack([factor, factor, np.ones_like(factor)]))

    dimple_m = curve[-1, 1]
    path = sections.smooth_curve(
        [
            (0.0, 0.0, dimple_m - 0.003),
            (0.2 * size.stem_lean_m, 0.0, dimple_m + 0.5 * size.stem_length_m),
            (size.stem_lean_m, 0.0, dimple_m + size.stem_length_m),
        ],
        16,
    )
    stem = solids.sweep(
        path, sections.circle(size.stem_radius_m, 16), np.linspace(0.9, 1.5, 16), up=(0, 1, 0)
    )
    calyx = solids.ellipsoid((0.0035, 0.0035, 0.0030), 24).translate((0, 0, curve[0, 1]))
    return {
        "flesh": solids.revolve(profile).warp_batch(furrow),
        "stem": stem,
        "calyx": calyx,
    }


def banana(size: Size) -> Solids:
    """The banana: body, stem and tip."""
    body = _banana_length(size, 0.0, 1.0, 1.0)
    stem = _banana_length(size, -0.004, size.stem_fraction, 1.04)
    tip = _banana_length(size, 1.0 - size.tip_fraction, 1.004, 1.05)
    low_x, _, low_z, high_x, _, high_z = (body + stem + tip).bounding_box()
    centre = (-(low_x + high_x) / 2, 0.0, -(low_z + high_z) / 2)
    return {
        "body": body.translate(centre),
        "stem": stem.translate(centre),
        "tip": tip.translate(centre),
    }


def _banana_length(size: Size, start: float, end: float, swell: float) -> Manifold:
    """Sweep the stretch of the banana between two fractions of its length."""
    half_turn = np.arcsin(size.length_m / 2 / (size.bend_radius_m + size.girth_m[0][1]))
    along = np.linspace(start, end, max(6, int(80 * (end - start))))
    turn = half_turn * (2 * along - 1)
    arc = np.column_stack([np.sin(turn), 1 - np.cos(turn)])
    path = size.bend_radius_m * sections.in_xz(arc)
    angle = 2 * np.pi * np.arange(60) / 60
    ridged = 1 + size.ridge_height * (np.cos(size.ridges * (angle + np.pi / 2)) - 1) / 2
    section = ridged[:, None] * sections.circle(1.0, 60)
    stations, radii = np.asarray(size.girth_m).T
    scales = swell * sections.monotone_curve(stations, radii, np.clip(along, 0, 1))
    return solids.sweep(path, section, scales)
