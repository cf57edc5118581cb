"""The 19 objects of ContactGrasp (Brahmbhatt et al. 2019) by name."""

from collections.abc import Callable

from grasptypes.objects import cookware, fruit, turned, vessels
from grasptypes.objects.parts import ObjectModel

OBJECTS: dict[str, Callable[..., ObjectModel]] = {
    "apple": fruit.apple,
    "banana": fruit.banana,
    "bowl": vessels.bowl,
    "cup": vessels.cup,
    "light_bulb": turned.light_bulb,
    "mug": vessels.mug,
    "pan": cookware.pan,
    "utah_teapot": cookware.utah_teapot,
    "water_bottle": turned.water_bottle,
    "wine_glass": vessels.wine_glass,
}
