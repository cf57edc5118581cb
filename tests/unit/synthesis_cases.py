"""Shared by the tests of synthesis: a ball of 60 mm, the sampled hand, and who holds the ball."""

from functools import cache
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import ArrayLike
from tests.unit.settings import RAW

from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import write_collision
from grasptypes.synthesis.candidates import Person
from grasptypes.synthesis.fields import Field, field
from grasptypes.synthesis.hand_model import HandModel, hand_model
from grasptypes.synthesis.holding import RigidObject
from grasptypes.synthesis.search import Thing

ROOT = Path(__file__).parents[2]
URDF = ROOT / "assets" / "barrett_hand" / "barrett_hand.urdf"
PARAMS = RAW
RADIUS_M = 0.03


@cache
def ball() -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=4, radius=RADIUS_M)


@cache
def ball_grid() -> Field:
    mesh = ball()
    return field(DistanceGrid.from_mesh(mesh.vertices, mesh.faces, 0.002, 0.02))


@cache
def model() -> HandModel:
    return hand_model(0.006, 0.012, 0.004, 0.02)


def ball_thing() -> Thing:
    return Thing(ball_grid(), np.zeros(3), RADIUS_M, ball().vertices)


def palm_at(distance_m: float) -> np.ndarray:
    """(1, 4, 4) a hand that looks along the object's -z at its origin from above."""
    T = np.diag([1.0, -1.0, -1.0, 1.0])
    T[2, 3] = distance_m
    return T[None]


def ball_person(grip: str = "enclose") -> Person:
    """Somebody who holds the ball from above by its upper half."""
    points, faces = trimesh.sample.sample_surface(ball(), 600, seed=1)
    return Person(
        points_m=np.asarray(points),
        normals=ball().face_normals[faces],
        contact=(points[:, 2] > 0).astype(float),
        grip=grip,
        approach=np.array([0.0, 0.0, -1.0]),
        closing=np.array([0.0, 1.0, 0.0]),
        centre_m=np.zeros(3),
    )


def ball_body(folder: Path, mass_kg: float = 0.1, centre_m: ArrayLike = (0, 0, 0)) -> RigidObject:
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=RADIUS_M)
    mesh.apply_translation(centre_m)
    write_collision(folder / "collision.obj", [(mesh.vertices, mesh.faces.astype(np.int32))])
    inertia = 0.4 * mass_kg * RADIUS_M**2 * np.eye(3)
    return RigidObject(folder / "collision.obj", mass_kg, np.array(centre_m), inertia)
