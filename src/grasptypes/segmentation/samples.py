"""Points on shapes of kinds, with their descriptors and roles: what the network learns from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from grasptypes.files import read_npz, write_npz
from grasptypes.kinds.library import read_kind
from grasptypes.kinds.modelling import build_shape
from grasptypes.kinds.names import shape_of
from grasptypes.objects import solids
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import face_parts, joined, scaled_parts
from grasptypes.seeds import rng, seed
from grasptypes.segmentation.descriptors import Cloud, describe_points
from grasptypes.settings.roles import read_roles
from grasptypes.settings.segmentation import DescriptorSettings, RoleSampleSettings

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RoleSamples:
    """Points of shapes.

    Attributes:
        shapes, families: (S,) names of the shapes and of the families of their kinds.
        points_m, normals: (S, M, 3) float32, spread evenly over each surface, in random order.
        roles: (S, M) role of each point, its place in roles.yaml.
        descriptors: (S, N, D) float32 of the first N points of each shape.
    """

    shapes: NDArray[np.str_]
    families: NDArray[np.str_]
    points_m: NDArray[np.float32]
    normals: NDArray[np.float32]
    roles: NDArray[np.int64]
    descriptors: NDArray[np.float32]

    def write(self, path: str | Path) -> None:
        """Write the samples."""
        write_npz(path, {name: getattr(self, name) for name in self.__dataclass_fields__})


def read_samples(paths: Sequence[str | Path]) -> RoleSamples:
    """The samples of several files, one after the other.

    Raises:
        InputError: a file is damaged.
    """
    files = [read_npz(path) for path in paths]
    names = RoleSamples.__dataclass_fields__
    return RoleSamples(**{name: np.concatenate([file[name] for file in files]) for name in names})


def family_weights(families: NDArray[np.str_]) -> NDArray[np.float32]:
    """Weights (n,) of shapes, with mean 1: a family of four times as many counts twice as much."""
    _, family, count = np.unique(families, return_inverse=True, return_counts=True)
    weights = 1 / np.sqrt(count[family])
    return np.asarray(weights / weights.mean(), dtype=np.float32)


def sample_shapes(
    names: Sequence[str], described: DescriptorSettings, settings: RoleSampleSettings
) -> RoleSamples:
    """Samples of shapes of kinds by name, such as mallet_s01."""
    rows = []
    for name in names:
        points_m, normals, roles = altered(
            sample_roles(build_shape(name), name, described.points),
            settings,
            rng("altered shape", name),
        )
        cloud = Cloud.of_points(points_m, normals, len(points_m))
        descriptors = describe_points(
            cloud, points_m[: settings.points], normals[: settings.points], described
        )
        rows.append((points_m, normals, roles, descriptors))
    points, normals_, roles_, descriptors_ = (
        np.stack(column) for column in zip(*rows, strict=True)
    )
    return RoleSamples(
        np.array(names),
        np.array([read_kind(shape_of(name)[0]).family for name in names]),
        points.astype(np.float32),
        normals_.astype(np.float32),
        roles_,
        descriptors_,
    )


def altered(
    sample: tuple[Array, Array, NDArray[np.int64]],
    settings: RoleSampleSettings,
    draw: np.random.Generator,
) -> tuple[Array, Array, NDArray[np.int64]]:
    """A sample of another shape of the kind, as a scanner may see it: stretched, rough, with a
    hole.

    What is lost in the hole is replaced by points elsewhere, so that there are as many as before.
    """
    points_m, normals, roles = sample
    stretch = np.exp(draw.uniform(-1, 1, 3) * np.log(settings.stretch))
    points_m, normals = points_m * stretch, normals / stretch
    normals = normals + settings.normal_noise * draw.standard_normal(normals.shape)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points_m = points_m + settings.roughness_m * draw.standard_normal(points_m.shape)
    centre_m = points_m[draw.integers(len(points_m))]
    order = np.argsort(np.linalg.norm(points_m - centre_m, axis=1))
    kept = np.sort(order[int(draw.uniform(0, settings.hole_share) * len(points_m)) :])
    rows = np.concatenate([kept, draw.choice(kept, len(points_m) - len(kept))])
    return points_m[rows], normals[rows], roles[rows]


def sample_roles(
    imported: ImportedModel, name: str, count: int
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Points (count, 3), outward normals (count, 3) and roles (count,) of a model whose parts all
    have roles."""
    parts = scaled_parts(imported.model, imported.scale)
    solid = joined(parts)
    order = list(read_roles().roles)
    of_part = np.array([order.index(part.role.role) for part in parts if part.role])
    mesh = trimesh.Trimesh(*solids.to_mesh(solid), process=False)
    points_m, face = sample_evenly(mesh, count, name)
    return points_m, mesh.face_normals[face], of_part[face_parts(solid, parts)[face]]


def sample_evenly(mesh: trimesh.Trimesh, count: int, name: str) -> tuple[Array, NDArray[np.intp]]:
    """Exactly `count` points (count, 3) spread evenly over a mesh, and the face (count,) of
    each."""
    number = seed("role points", name) % 2**31
    points_m, face = trimesh.sample.sample_surface_even(mesh, count, seed=number)
    if missing := count - len(points_m):  # the even ones may run out
        more_m, more = trimesh.sample.sample_surface(mesh, missing, seed=number)[:2]
        points_m, face = np.concatenate([points_m, more_m]), np.concatenate([face, more])
    return np.asarray(points_m), np.asarray(face)
