"""What an object is made of: named solids with a material, and how heavy the whole is."""

from dataclasses import dataclass

from manifold3d import Manifold


@dataclass(frozen=True)
class Material:
    """A surface as glTF's metallic-roughness model sees it.

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

    Parts may overlap: the object is their union, and each part owns what it shows of it.
    `density_kg_m3` is set where the part is of heavier or lighter stuff than the object.
    """

    name: str
    solid: Manifold
    material: Material
    density_kg_m3: float | None = None


@dataclass(frozen=True)
class ObjectModel:
    """An object at ContactDB's original scale in ContactDB's frame.

    Attributes:
        parts: the solids whose union is the object.
        density_kg_m3: density of the walls (with a shell thickness) or of the whole solid.
        shell_thickness_m: wall thickness if the real thing is hollow where the model is solid.
    """

    parts: tuple[Part, ...]
    density_kg_m3: float
    shell_thickness_m: float | None = None
