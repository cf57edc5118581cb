"""One way to hold an object: which parts, with which grip, and from which side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# Each grip belongs to one of the two styles in Figure 2 (a) of the paper.
STYLE_OF_GRIP = {
    "wrap": "power",
    "enclose": "power",
    "tripod": "precision",
    "pinch": "precision",
    "rim": "precision",
}
# The grip behind each grasp type (Figure 2 of the paper).
GRIP_OF_TYPE = {
    "Large Wrap": "wrap",
    "Medium Wrap": "wrap",
    "Small Wrap": "wrap",
    "Power Sphere": "enclose",
    "Precision Sphere": "tripod",
    "Precision": "pinch",
}
WHOLE = "*"


@dataclass(frozen=True, eq=False)
class Hold:
    """One way to hold an object (its frame).

    Attributes:
        parts: names of the parts between palm, fingers and thumb; empty for the whole object.
        touchable: names of all parts that the hand may touch, `parts` among them; empty for any.
        grip: `wrap` (palm and parallel fingers around the axis), `enclose` (palm and spread
            fingers), `tripod` (fingertips spread around the approach), `pinch` (fingertips against
            the thumb), `rim` (fingertips on both sides of a wall's edge).
        sides: (K, 3) unit vectors from the object to the palm, one of which a person chooses; None
            for any side of the axis.
        axis: (3,) unit vector around which the parts are held; None for their longest extent.
        low, high: range of the hand's centre along that axis, as fractions of the parts' extent.
        probability: that a person chooses this hold, relative to the others.
    """

    parts: tuple[str, ...]
    touchable: tuple[str, ...]
    grip: str
    sides: NDArray[np.float64] | None
    axis: NDArray[np.float64] | None
    low: float
    high: float
    probability: float

    @property
    def part(self) -> str:
        """Names of the held parts, joined by `+`; `*` for the whole object."""
        return "+".join(self.parts) or WHOLE
