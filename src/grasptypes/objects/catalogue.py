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
from grasptypes.objects.parts import ObjectModel

OBJECTS: dict[str, Callable[..., ObjectModel]] = {
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
