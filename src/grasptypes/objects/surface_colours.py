"""Colours of a user's mesh: as its file states them, and looked up at points of its surface.

Materials and textures are sRGB where the format does not say otherwise; everything in between is
linear, as rendering and glTF need it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import igl
import numpy as np
from numpy.typing import NDArray

from grasptypes.objects.parts import Material

Array = NDArray[np.float64]

GREY = Material((0.62, 0.62, 0.60, 1.0), roughness=0.6)
# What carries the colours of vertices, faces or textures where a file names no material.
PAPER = Material((1.0, 1.0, 1.0, 1.0), roughness=GREY.roughness)


def linear(srgb: NDArray[np.floating]) -> Array:
    """Linear values of sRGB values, 0 to 1 (IEC 61966-2-1)."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def encoded(values: NDArray[np.floating]) -> Array:
    """sRGB values of linear values, 0 to 1 (IEC 61966-2-1)."""
    return np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)


@dataclass(frozen=True, eq=False)
class Look:
    """A material and, if it has one, its texture: (H, W, 3) uint8 sRGB, repeated in all directions.

    Texture coordinates are (0, 0) at the lower left corner.
    """

    material: Material
    texture: NDArray[np.uint8] | None = None

    def colours(self, uv: Array) -> Array:
        """Linear colours (N, 3) at texture coordinates (N, 2)."""
        base = linear(np.array(self.material.base_color[:3]))
        if self.texture is None:
            return np.broadcast_to(base, (len(uv), 3))
        height, width = self.texture.shape[:2]
        column = np.floor(uv[:, 0] % 1 * width).astype(int) % width
        row = np.floor(-uv[:, 1] % 1 * height).astype(int) % height
        return np.asarray(base * linear(self.texture[row, column] / 255))


@dataclass(frozen=True)
class FaceColours:
    """Colours of faces with any number of corners, C together.

    Attributes:
        looks: the looks of the file.
        look: (F,) index into looks.
        tint: (C, 3) linear factor at each corner, from colours of vertices or faces.
        uv: (C, 2) texture coordinates of each corner.
    """

    looks: tuple[Look, ...]
    look: NDArray[np.int64]
    tint: Array
    uv: Array

    def cut(self, corners: NDArray[np.int64], owners: NDArray[np.int64]) -> FaceColours:
        """The colours of triangles, made of `corners` (T, 3) of the faces `owners` (T,)."""
        flat = corners.reshape(-1)
        return FaceColours(self.looks, self.look[owners], self.tint[flat], self.uv[flat])


def plain(faces: int) -> FaceColours:
    """Grey triangles."""
    look = np.zeros(faces, dtype=np.int64)
    return FaceColours((Look(GREY),), look, np.ones((3 * faces, 3)), np.zeros((3 * faces, 2)))


@dataclass(frozen=True)
class SurfaceColours:
    """Colours of a triangle soup.

    Attributes:
        triangles_m: (F, 3, 3) corners in metres.
        colours: of its faces.
        spacing_m: distance between points at which the colours are looked up.
    """

    triangles_m: Array
    colours: FaceColours
    spacing_m: float

    def scaled(self, scale: float) -> SurfaceColours:
        """The colours of the surface at another size."""
        return replace(self, triangles_m=self.triangles_m * scale, spacing_m=self.spacing_m * scale)

    def at(self, points_m: Array) -> tuple[NDArray[np.int64], Array]:
        """Look (N,) and linear colour (N, 3) of the surface nearest to points (N, 3)."""
        corners = np.ascontiguousarray(self.triangles_m.reshape(-1, 3))
        faces = np.arange(len(corners)).reshape(-1, 3)
        _, nearest, places = igl.point_mesh_squared_distance(
            np.ascontiguousarray(points_m), corners, faces
        )
        a, b, c = (np.ascontiguousarray(self.triangles_m[nearest, k]) for k in range(3))
        weights = np.clip(igl.barycentric_coordinates(np.ascontiguousarray(places), a, b, c), 0, 1)
        look = self.colours.look[nearest]
        tint, uv = (
            np.einsum("nk,nki->ni", weights, values.reshape(len(faces), 3, -1)[nearest])
            for values in (self.colours.tint, self.colours.uv)
        )
        base = np.ones((len(look), 3))
        for index in np.unique(look).tolist():
            chosen = look == index
            base[chosen] = self.colours.looks[index].colours(uv[chosen])
        return look, base * tint

    def of_vertices(self, look: int, points_m: Array) -> tuple[Material, Array | None]:
        """Material of a look, and linear factors (N, 3) on its colour if it varies over points."""
        material, texture = self.colours.looks[look].material, self.colours.looks[look].texture
        corners = np.repeat(self.colours.look == look, 3)
        if texture is None and (self.colours.tint[corners] == 1).all():
            return material, None
        white = replace(material, base_color=(1.0, 1.0, 1.0, material.base_color[3]))
        return white, self.at(points_m)[1]

    def material(self) -> Material | None:
        """The material of all faces; None if they differ."""
        looks = [self.colours.looks[index] for index in np.unique(self.colours.look).tolist()]
        materials: set[Material] = {look.material for look in looks}
        textured = any(look.texture is not None for look in looks)
        if len(materials) > 1 or textured or (self.colours.tint != 1).any():
            return None
        return materials.pop()


def joined(pieces: Sequence[Array], colours: Sequence[FaceColours], cells: int) -> SurfaceColours:
    """The colours of pieces of a mesh, each with the corners (F, 3, 3) of its faces in metres.

    Args:
        cells: number of points along the longest extent at which the colours are looked up.
    """
    triangles_m = np.concatenate(pieces)
    firsts = np.cumsum([0, *(len(some.looks) for some in colours)])
    whole = FaceColours(
        tuple(look for some in colours for look in some.looks),
        np.concatenate([some.look + first for some, first in zip(colours, firsts, strict=False)]),
        np.concatenate([some.tint for some in colours]),
        np.concatenate([some.uv for some in colours]),
    )
    # Faces without area show nothing and have no barycentric coordinates.
    edges = triangles_m[:, 1:] - triangles_m[:, :1]
    shown = np.flatnonzero(np.cross(edges[:, 0], edges[:, 1]).any(axis=1))
    corners = np.arange(3 * len(triangles_m)).reshape(-1, 3)[shown]
    spacing_m = float(np.ptp(triangles_m.reshape(-1, 3), axis=0).max()) / cells
    return SurfaceColours(triangles_m[shown], whole.cut(corners, shown), spacing_m)
