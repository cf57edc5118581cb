"""Comparison of two shapes: Chamfer distance of the surfaces, IoU of the volumes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import igl
import numpy as np
import pandas as pd
import pandera.pandas as pa
import trimesh
from numpy.typing import NDArray

from grasptypes import seeds
from grasptypes.errors import InputError
from grasptypes.objects import object_files

Array = NDArray[np.float64]

# Offset from a face at which its two sides are probed; far below any wall, far above rounding.
SIDE_OFFSET_M = 2e-5


# In millimetres, the natural scale for readers.
SHAPE_TABLE = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "chamfer_mm": pa.Column(float, pa.Check.ge(0)),
        "chamfer_p95_mm": pa.Column(float, pa.Check.ge(0)),
        "iou": pa.Column(float, pa.Check.in_range(0, 1)),
    },
    strict=True,
    ordered=True,
)


def compare(
    model: trimesh.Trimesh,
    reference: trimesh.Trimesh,
    surface_samples: int = 20_000,
    volume_samples: int = 300_000,
) -> dict[str, float]:
    """Compare two meshes (metres, same frame); they need not be watertight.

    Returns:
        The columns of `SHAPE_TABLE` without the object. The Chamfer distances pool both directions:
        mean and 95th percentile of the distance from a surface sample to the other surface; IoU is
        the volume of the intersection over that of the union.
    """
    there = _distances(sample_surface(model, surface_samples), reference)
    back = _distances(sample_surface(reference, surface_samples), model)
    pooled_mm = 1e3 * np.concatenate([there, back])
    return {
        "chamfer_mm": 1e3 * float(there.mean() + back.mean()) / 2,
        "chamfer_p95_mm": float(np.percentile(pooled_mm, 95)),
        "iou": intersection_over_union(model, reference, volume_samples),
    }


def compare_folder(
    objects: Sequence[Path], references: Path, surface_samples: int, volume_samples: int
) -> pd.DataFrame:
    """Compare prepared objects with the references `<object>.stl` (metres, scale 1).

    Args:
        objects: folders as in `object_files`; those without a reference are skipped.
        references: folder of reference meshes.

    Returns:
        A `SHAPE_TABLE`, rounded to the precision of the sampling.

    Raises:
        InputError: the folder has no reference for any of the objects.
    """
    rows = []
    for folder in objects:
        properties = object_files.read_properties(folder / object_files.PROPERTIES)
        path = references / f"{properties.object}.stl"
        if not path.is_file():
            continue
        surface = object_files.read_surface(folder / object_files.SURFACE)
        model = trimesh.Trimesh(surface.vertices / properties.scale, surface.faces, process=False)
        figures = compare(model, trimesh.load_mesh(path), surface_samples, volume_samples)
        rows.append({"object": properties.object, **figures})
    if not rows:
        raise InputError(references, "", "has no <object>.stl for any of the compared objects")
    table = pd.DataFrame(rows)
    return table.round({"chamfer_mm": 2, "chamfer_p95_mm": 2, "iou": 3})


def inside(mesh: trimesh.Trimesh, points_m: Array) -> NDArray[np.bool_]:
    """Tell which of (N, 3) points lie in a mesh, watertight or not.

    A point is inside where the generalised winding number (Jacobson et al. 2013; fast evaluation
    by Barill et al. 2018) exceeds one half. Small holes barely change it, overlapping bodies count
    as one, and the absolute value allows for scans turned inside out.
    """
    winding = igl.fast_winding_number(*_arrays(mesh), np.ascontiguousarray(points_m))
    return np.asarray(np.abs(winding) > 0.5)


def sample_surface(mesh: trimesh.Trimesh, count: int) -> Array:
    """Draw up to `count` points (M, 3), uniformly by area, from the boundary of a mesh's interior.

    Faces with the interior on both sides are buried where bodies overlap; samples on them are
    dropped.
    """
    generator = seeds.rng("shape_comparison", "surface")
    points, faces = trimesh.sample.sample_surface(mesh, count, seed=generator)
    points = np.asarray(points)
    step = SIDE_OFFSET_M * mesh.face_normals[faces]
    buried = inside(mesh, points + step) & inside(mesh, points - step)
    return points[~buried]


def intersection_over_union(a: trimesh.Trimesh, b: trimesh.Trimesh, samples: int) -> float:
    """Estimate the IoU from about `samples` points, one per cell of a regular grid.

    The points are jittered within their cells, because millimetre walls alias with a regular grid
    of similar spacing.
    """
    lower = np.minimum(a.bounds[0], b.bounds[0])
    extent = np.maximum(a.bounds[1], b.bounds[1]) - lower
    spacing = float(np.cbrt(np.prod(extent) / samples))
    cells = np.stack(
        np.meshgrid(*(np.arange(int(np.ceil(side / spacing))) for side in extent), indexing="ij"),
        axis=-1,
    ).reshape(-1, 3)
    jitter = seeds.rng("shape_comparison", "volume").random(cells.shape)
    points = lower + spacing * (cells + jitter)
    in_a, in_b = inside(a, points), inside(b, points)
    return float((in_a & in_b).sum() / max((in_a | in_b).sum(), 1))


def _distances(points: Array, mesh: trimesh.Trimesh) -> Array:
    """Return the distance (N,) of points to a mesh's surface."""
    squared = igl.point_mesh_squared_distance(np.ascontiguousarray(points), *_arrays(mesh))[0]
    return np.asarray(np.sqrt(squared))


def _arrays(mesh: trimesh.Trimesh) -> tuple[Array, NDArray[np.int64]]:
    """Vertices (V, 3) and faces (F, 3) as libigl takes them."""
    return (
        np.ascontiguousarray(mesh.vertices, dtype=np.float64),
        np.ascontiguousarray(mesh.faces, dtype=np.int64),
    )
