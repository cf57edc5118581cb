"""A user's point cloud: read, and wrapped in a surface that can be drawn."""

from __future__ import annotations

import importlib
from pathlib import Path

import igl
import numpy as np
import trimesh
from scipy.spatial import cKDTree

from grasptypes.errors import InputError, parsing
from grasptypes.objects.file_formats import POINTS
from grasptypes.objects.ply_file import ply_points, read_ply
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.commands import CloudSettings

PCD_READER = "pypcd4"


def is_cloud(path: Path) -> bool:
    """Whether a file is a point cloud: by its suffix, and a PLY file if it has no faces.

    Raises:
        InputError: a PLY file is damaged.
    """
    suffix = path.suffix.lower()
    if suffix != ".ply":
        return suffix in POINTS
    if not path.is_file():
        return False
    found = read_ply(path)
    faces = [found[name] for name in ("face", "tristrips") if name in found]
    return not any(element.count for element in faces)


def read_cloud(path: Path, unit: str, settings: CloudSettings) -> np.ndarray:
    """The points (N, 3) of a file in metres; points with missing coordinates are left out.

    Raises:
        InputError: the file has no points, too few or too many, or they all lie in a plane.
    """
    if unit not in UNITS_M:
        raise InputError("--unit", unit, f"unknown; allowed: {', '.join(UNITS_M)}")
    if not path.is_file():
        raise InputError(path, "", "no such file")
    raw = _READERS[path.suffix.lower()](path)
    points = raw[np.isfinite(raw).all(axis=1)].astype(np.float64) * UNITS_M[unit]
    low, high = settings.points
    if not low <= len(points) <= high:
        raise InputError(path, "", f"has {len(points)} points; must be {low} to {high}")
    if np.linalg.matrix_rank(points - points.mean(axis=0), tol=1e-9) < 3:
        raise InputError(path, "", "its points lie in a plane or a line")
    return np.asarray(points)


def wrapped(points: np.ndarray, settings: CloudSettings) -> trimesh.Trimesh:
    """The surface of balls around the points (N, 3), which overlap those of their neighbours."""
    tree = cKDTree(points)
    gaps = tree.query(points, k=2)[0][:, 1]
    spacing = float(np.ptp(points, axis=0).max()) / settings.cells
    radius = max(settings.ball * float(np.quantile(gaps, 0.9)), spacing)
    low = points.min(axis=0) - radius - 2 * spacing
    counts = np.ceil((points.max(axis=0) + radius + 2 * spacing - low) / spacing).astype(int) + 1
    # In libigl's grids, x varies fastest.
    grid = np.indices(counts[::-1]).reshape(3, -1)[::-1].T
    nodes = np.ascontiguousarray(grid * spacing + low)
    values = np.ascontiguousarray(tree.query(nodes)[0] - radius)
    vertices, faces = igl.marching_cubes(values, nodes, *(int(n) for n in counts), 0.0)[:2]
    mesh = trimesh.Trimesh(vertices, faces)
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def extents(points: np.ndarray) -> tuple[float, ...]:
    """Lengths of the smallest box around the points (N, 3), longest first."""
    return tuple(sorted(map(float, trimesh.bounds.oriented_bounds(points)[1]), reverse=True))


def _read_ply_points(path: Path) -> np.ndarray:
    return np.asarray(ply_points(path, read_ply(path)))


def _read_array(path: Path) -> np.ndarray:
    with parsing(path, "not an array"):
        found = np.load(path, allow_pickle=False)
    if found.ndim != 2 or found.shape[1] not in (3, 6) or not np.issubdtype(found.dtype, np.number):
        message = f"holds {found.dtype} of shape {found.shape}; points need (N, 3) numbers"
        raise InputError(path, "", message)
    return np.asarray(found[:, :3])


def _read_pcd(path: Path) -> np.ndarray:
    try:
        reader = importlib.import_module(PCD_READER)
    except ModuleNotFoundError as error:
        message = f"PCD files need a reader: pip install {PCD_READER} (or convert it to PLY)"
        raise InputError(path, "", message) from error
    with parsing(path, "not a PCD file"):
        return np.asarray(reader.PointCloud.from_path(path).numpy(("x", "y", "z")))


_READERS = {".ply": _read_ply_points, ".npy": _read_array, ".pcd": _read_pcd}
