"""Other sizes and proportions of an object, drawn from ranges."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from grasptypes.kinds.catalogue import build
from grasptypes.objects import solids
from grasptypes.objects.parts import ObjectModel
from grasptypes.objects.variants import variant_of
from grasptypes.seeds import rng
from grasptypes.settings.objects import VariationRanges

Array = NDArray[np.float64]
# Parts whose boxes meet this closely were cut from one solid; designed gaps are far wider.
JOINT_M = 1e-9


@dataclass(frozen=True)
class Variation:
    """How a variant differs from its object; shares refer to the object's bounding box.

    Planes across x, y or z stay planes, and those across the tapered axis keep their position:
    parts cut from one solid keep their common face, and small parts stay on the face they lie on.

    Attributes:
        size: factor on all lengths, walls included.
        stretch: (3,) a further factor along x, y and z.
        balance: (3,) shift of the middle along x, y and z, as a share of the extent: one side of it
            grows and the other shrinks. Below 0.25 nothing is inverted.
        taper: share by which the section grows from the middle to the upper end of one axis
            (see :func:`taper_axis`) and shrinks towards the lower end.
    """

    size: float
    stretch: tuple[float, float, float]
    balance: tuple[float, float, float]
    taper: float

    def move(self, points_m: Array, lower_m: Array, upper_m: Array, axis: int) -> Array:
        """Map points (N, 3) of an object with the box (3,) to (3,), tapered along `axis`."""
        extent_m, middle_m = upper_m - lower_m, (lower_m + upper_m) / 2
        share = (points_m - lower_m) / extent_m
        share = share + 4.0 * np.asarray(self.balance) * share * (1.0 - share)
        offset_m = (share - 0.5) * extent_m
        section = 1.0 + self.taper * (2.0 * share[:, axis] - 1.0)
        across = np.arange(3) != axis
        offset_m[:, across] *= section[:, None]
        return middle_m + self.size * np.asarray(self.stretch) * offset_m


def draw_variation(ranges: VariationRanges, draw: np.random.Generator) -> Variation:
    """Draw a variation, uniformly from every range."""
    return Variation(
        size=float(draw.uniform(*ranges.size)),
        stretch=tuple(draw.uniform(*ranges.stretch, 3).tolist()),
        balance=tuple(draw.uniform(*ranges.balance, 3).tolist()),
        taper=float(draw.uniform(*ranges.taper)),
    )


def vary(model: ObjectModel, variation: Variation) -> ObjectModel:
    """Return the variant of a model: parts, materials and densities are kept.

    A taper would tear apart parts that meet along planes across several axes; it is then skipped.
    """
    varied = _moved(model, variation)
    if variation.taper and _pieces(varied) != _pieces(model):
        varied = _moved(model, replace(variation, taper=0.0))
    return varied


def _moved(model: ObjectModel, variation: Variation) -> ObjectModel:
    boxes = np.array([part.solid.bounding_box() for part in model.parts]).reshape(-1, 2, 3)
    lower_m, upper_m, axis = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0), taper_axis(boxes)

    def move(points: Array) -> Array:
        """Map points (N, 3) of the object to the variant."""
        return variation.move(np.asarray(points), lower_m, upper_m, axis)

    parts = tuple(replace(part, solid=part.solid.warp_batch(move)) for part in model.parts)
    thickness_m = model.shell_thickness_m
    scaled_m = None if thickness_m is None else thickness_m * variation.size
    return replace(model, parts=parts, shell_thickness_m=scaled_m)


def _pieces(model: ObjectModel) -> int:
    """Number of pieces of the union of the parts."""
    return len(solids.union(*(part.solid for part in model.parts)).decompose())


def taper_axis(boxes_m: Array) -> int:
    """The axis along which parts were cut from one solid, otherwise the longest axis.

    A cut must stay at exactly one position to vanish in the union.

    Args:
        boxes_m: (parts, 2, 3) corners of the parts' bounding boxes.
    """
    lower_m, upper_m = boxes_m[:, None, 0], boxes_m[None, :, 1]
    joints = (np.abs(lower_m - upper_m) < JOINT_M).any(axis=(0, 1))
    extents_m = boxes_m[:, 1].max(axis=0) - boxes_m[:, 0].min(axis=0)
    return int(np.argmax(joints)) if joints.any() else int(np.argmax(extents_m))


def build_variant(name: str, ranges: VariationRanges, seed: int) -> ObjectModel:
    """Build a variant of a catalogue object, the same one for the same name and seed.

    Args:
        name: of the variant, see :mod:`grasptypes.objects.variants`.
    """
    base, number = variant_of(name)
    draw = rng("variant", base, number, seed)
    return vary(build(base), draw_variation(ranges, draw))
