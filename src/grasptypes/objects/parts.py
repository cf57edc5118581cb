"""Object models: named solids with materials and densities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from manifold3d import Manifold

from grasptypes.settings.roles import PartRole

if TYPE_CHECKING:
    from grasptypes.objects.surface_colours import SurfaceColours


@dataclass(frozen=True)
class Material:
    """A surface in glTF's metallic-roughness model.

    Attributes:
        base_color: red, green, blue (sRGB) and opacity, each 0 to 1.
        metallic: 0 for plastic, wood and glass, 1 for bare metal.
        roughness: 0 mirror-like, 1 matt.
    """

    base_color: tuple[float, float, float, float]
    metallic: float = 0.0
    roughness: float = 0.6


@dataclass(frozen=True)
class Part:
    """A named solid (metres, object frame at scale 1) of one material.

    Parts may overlap: the object is their union, and each part owns its visible surface.
    `density_kg_m3` is set if the part's material is heavier or lighter than the object's, `role` if
    it is known what the part is for.
    """

    name: str
    solid: Manifold
    material: Material
    density_kg_m3: float | None = None
    role: PartRole | None = None


@dataclass(frozen=True)
class ObjectModel:
    """An object at ContactDB's original scale in ContactDB's frame.

    Attributes:
        parts: the solids whose union is the object.
        density_kg_m3: density of the walls (with a shell thickness) or of the whole solid.
        shell_thickness_m: wall thickness if the real object is hollow and the model solid.
        cavities: closed hollows inside the parts' solids; they count for mass and inertia alone,
            since neither hand nor camera reaches them.
        colours: of the surface of a user's mesh, instead of the parts' materials.
    """

    parts: tuple[Part, ...]
    density_kg_m3: float
    shell_thickness_m: float | None = None
    cavities: Manifold | None = None
    colours: SurfaceColours | None = None


@dataclass(frozen=True)
class ImportedModel:
    """An object that is to be prepared.

    Attributes:
        model: for a user's mesh one part `body`, or one part per named geometry of a GLB.
        scale: size to prepare it at.
        mass_kg: given mass; None if the density decides.
        repairs: what was mended, in words.
    """

    model: ObjectModel
    scale: float
    mass_kg: float | None = None
    repairs: tuple[str, ...] = ()
