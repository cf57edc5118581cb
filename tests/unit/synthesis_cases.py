"""Shared by the tests of synthesis: a ball of 60 mm, the sampled hand, and who holds the ball."""

from functools import cache
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import ArrayLike
from tests.unit.barrett import BARRETT
from tests.unit.settings import PARAMS

from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import COLLISION, Properties, write_collision
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.synthesis.candidates import Demonstration
from grasptypes.synthesis.closing import close_fingers
from grasptypes.synthesis.fields import field
from grasptypes.synthesis.hand_model import hand_model
from grasptypes.synthesis.scene import GraspScene

CLOSING = PARAMS.synthesis.closing
TOUCH_M = CLOSING.touch_m
RADIUS_M = 0.03


@cache
def ball() -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=4, radius=RADIUS_M)


@cache
def scene_of(size: str = "ball") -> GraspScene:
    """The coarse hand and the ball, or a flat box."""
    model = hand_model(BARRETT, 0.006, 0.012, 0.004, 0.02)
    mesh = ball() if size == "ball" else trimesh.creation.box((0.2, 0.05, 0.05))
    grid = DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.02)
    surface_m = np.asarray(mesh.vertices)
    return GraspScene(BARRETT, model, field(grid), np.zeros(3), RADIUS_M, surface_m)


def palm_at(distance_m: float) -> np.ndarray:
    """(1, 4, 4) a hand that looks along the object's -z at its origin from above."""
    T = np.diag([1.0, -1.0, -1.0, 1.0])
    T[2, 3] = distance_m
    return T[None]


def closed(
    T_object_hand: ArrayLike, *spreads_rad: float, scene: GraspScene | None = None
) -> np.ndarray:
    """Joint positions (n, 8) of hands at poses (n, 4, 4) that closed with these spreads."""
    preshape = np.array(spreads_rad)[:, None]
    hands = close_fingers(scene or scene_of(), np.asarray(T_object_hand), preshape, CLOSING)
    return hands.joint_positions


def ball_shown(grip: str = "enclose") -> Demonstration:
    """Somebody who holds the ball from above by its upper half."""
    points, faces = trimesh.sample.sample_surface(ball(), 600, seed=1)
    return Demonstration(
        points_m=np.asarray(points),
        normals=ball().face_normals[faces],
        contact=(points[:, 2] > 0).astype(float),
        grip=grip,
        approach=np.array([0.0, 0.0, -1.0]),
        closing=np.array([0.0, 1.0, 0.0]),
        centre_m=np.zeros(3),
    )


def ball_object(
    folder: Path, mass_kg: float = 0.1, centre_m: ArrayLike = (0, 0, 0)
) -> ObjectGeometry:
    """A ball that physics can hold."""
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=RADIUS_M)
    mesh.apply_translation(centre_m)
    write_collision(folder / COLLISION, [(mesh.vertices, mesh.faces.astype(np.int32))])
    properties = Properties(
        object="ball",
        scale=1.0,
        mass_kg=mass_kg,
        centre_of_mass_m=list(centre_m),
        inertia_kg_m2=(0.4 * mass_kg * RADIUS_M**2 * np.eye(3)).tolist(),
        density_kg_m3=1e3,
        shell_thickness_m=None,
        volume_m3=float(mesh.volume),
        watertight=True,
        bounds_m=mesh.bounds.tolist(),
        repairs=[],
        roles={},
    )
    return ObjectGeometry(folder, properties)
