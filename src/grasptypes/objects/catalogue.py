"""The 19 objects of ContactGrasp (Brahmbhatt et al. 2019) by name."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

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
from grasptypes.objects.parts import ObjectModel, Size
from grasptypes.yaml_files import read_yaml

DIMENSIONS = Path(__file__).with_name("dimensions.yaml")
OBJECTS: dict[str, Callable[[Size], ObjectModel]] = {
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
    """Build an object with the dimensions in `dimensions.yaml`, some of them changed."""
    return OBJECTS[name](Size(**(_dimensions()[name] | changes)))


@cache
def _dimensions() -> dict[str, Any]:
    return read_yaml(DIMENSIONS)
