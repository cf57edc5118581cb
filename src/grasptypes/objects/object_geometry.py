"""A prepared object with its shape and properties, read from its files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.object_files import (
    COLLISION,
    DISTANCE_GRID,
    PROPERTIES,
    SURFACE,
    VISUAL,
    Properties,
    Surface,
    read_properties,
    read_surface,
)


@dataclass(frozen=True)
class ObjectGeometry:
    """A prepared object: shape, named parts, mass and inertia (SI units, the object's frame).

    Attributes:
        folder: folder of its files, see `object_files`.
        properties: name, mass, centre of mass, inertia, bounds, and repairs.
        source: the user's mesh; empty for a catalogue object.
    """

    folder: Path
    properties: Properties
    source: str = ""

    @property
    def name(self) -> str:
        """The object's name."""
        return self.properties.object

    @property
    def visual(self) -> Path:
        """GLB of the visual mesh."""
        return self.folder / VISUAL

    @property
    def collision(self) -> Path:
        """OBJ with one group (`o`) per convex part."""
        return self.folder / COLLISION

    @cached_property
    def distance_grid(self) -> DistanceGrid:
        """Signed distance to the surface; raises InputError if the file is damaged."""
        return DistanceGrid.load(self.folder / DISTANCE_GRID)

    @cached_property
    def surface(self) -> Surface:
        """The surface with the part of each vertex; raises InputError if the file is damaged."""
        return read_surface(self.folder / SURFACE)


def read_object(folder: str | Path) -> ObjectGeometry:
    """The object in a folder of prepared files.

    Raises:
        InputError: files are missing or damaged.
    """
    return ObjectGeometry(Path(folder), read_properties(Path(folder) / PROPERTIES))
