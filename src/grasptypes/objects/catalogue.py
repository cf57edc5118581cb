"""The 19 objects of ContactGrasp (Brahmbhatt et al. 2019) by name."""

from collections.abc import Callable

from grasptypes.objects.parts import ObjectModel

OBJECTS: dict[str, Callable[..., ObjectModel]] = {}
