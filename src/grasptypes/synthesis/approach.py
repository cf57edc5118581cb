"""Move open hands along their approach until they touch an object, in batches.

No point of a hand moves farther than its signed distance to the object, so no step can jump over a
surface, however thin.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grasptypes.compiled import compiled
from grasptypes.hands.states import HandStates
from grasptypes.synthesis.fields import Field, distance
from grasptypes.synthesis.hand_model import HandModel
from grasptypes.synthesis.posed_links import least_gap, moved
from grasptypes.synthesis.scene import GraspScene

Array = NDArray[np.float64]

MAX_STEPS = 60


def slide_in(
    scene: GraspScene, T_object_hand: Array, preshape: Array, reach_m: Array, touch_m: float
) -> Array:
    """Move open hands along their approach (+z) until they touch or have moved `reach_m`.

    Args:
        T_object_hand: (n, 4, 4) hands in the object frame, clear of the object.
        preshape: (n, P) preshapes of the fingers.
        reach_m: (n,) maximum distance of each.
        touch_m: distance between surfaces at which a link stops.

    Returns:
        (n,) distance moved, metres.
    """
    hand = scene.hand
    poses = HandStates(hand, T_object_hand, hand.opened(preshape)).link_poses()
    approach = np.ascontiguousarray(T_object_hand[:, :3, 2])
    return _slide(scene.model, scene.field, poses, approach, reach_m, touch_m)


@compiled()
def _slide(
    model: HandModel, grid: Field, poses: Array, approach: Array, reach_m: Array, touch_m: float
) -> Array:
    travelled = np.zeros(len(poses))
    gaps = np.empty(len(model.points))
    for n in range(len(poses)):
        dx, dy, dz = approach[n]
        for link in range(len(model.radii)):
            gaps[model.starts[link] : model.starts[link + 1]] = least_gap(
                model, grid, link, poses[n, link]
            )
        for _ in range(MAX_STEPS):
            x, y, z = travelled[n] * dx, travelled[n] * dy, travelled[n] * dz
            step = reach_m[n] - travelled[n]
            for link in range(len(model.radii)):
                for m in range(model.starts[link], model.starts[link + 1]):
                    if gaps[m] <= touch_m or gaps[m] < step:
                        px, py, pz = moved(poses[n, link], model.points, m)
                        gaps[m] = distance(grid, px + x, py + y, pz + z)
                        step = min(step, gaps[m])
            travelled[n] += max(step, 0.0)
            if step <= touch_m:
                break
            gaps -= step
    return travelled
