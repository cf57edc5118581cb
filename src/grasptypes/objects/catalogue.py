"""The 19 objects of ContactGrasp (Brahmbhatt et al. 2019) by name."""

from collections.abc import Callable

from grasptypes.objects import (
    bathroom,
    blades,
    cookware,
    desk,
    fruit,
    phone,
    tools,
    turned,
    vessels,
)
from grasptypes.objects.part_roles import part_roles, read_catalogue
from grasptypes.objects.parts import Material, ObjectModel, Part, Size, Solids

OBJECTS: dict[str, Callable[[Size], Solids]] = {
    "apple": fruit.apple,
    "banana": fruit.banana,
    "bowl": vessels.bowl,
    "cell_phone": phone.cell_phone,
    "cup": vessels.cup,
    "flashlight": tools.flashlight,
    "hammer": tools.hammer,
    "knife": blades.knife,
    "light_bulb": turned.light_bulb,
    "mouse": desk.mouse,
    "mug": vessels.mug,
    "pan": cookware.pan,
    "scissors": blades.scissors,
    "stapler": desk.stapler,
    "toothbrush": bathroom.toothbrush,
    "toothpaste": bathroom.toothpaste,
    "utah_teapot": cookware.utah_teapot,
    "water_bottle": turned.water_bottle,
    "wine_glass": vessels.wine_glass,
}


def build(name: str, **changes: float) -> ObjectModel:
    """Build an object as `catalogue.yaml` describes it, with some of its dimensions changed."""
    entry = read_catalogue()[name]
    looks = {key: dict(look) for key, look in entry["materials"].items()}
    densities = {key: look.pop("density_kg_m3", None) for key, look in looks.items()}
    materials = {
        key: Material(tuple(look.pop("base_color")), **look) for key, look in looks.items()
    }
    shapes = OBJECTS[name](Size(**(entry["size"] | changes)))
    roles = part_roles(name)
    parts = []
    for part, solid in shapes.items():
        material = entry["parts"][part]["material"]
        parts.append(Part(part, solid, materials[material], densities[material], roles[part]))
    return ObjectModel(tuple(parts), entry["density_kg_m3"], entry.get("shell_thickness_m"))
