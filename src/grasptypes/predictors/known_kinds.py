"""The kinds that the predictor for unseen objects has learned from, to compare images with."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from grasptypes.files import write_bytes, zip_bytes
from grasptypes.kinds.names import shape_of
from grasptypes.predictors.memory import Memory
from grasptypes.renders.archives import read_named_pictures

LOOKS = "known_kinds.zip"


@dataclass(frozen=True)
class Neighbour:
    """A known kind that looks like what is shown.

    Attributes:
        name: of the kind.
        similarity: cosine of the angle between both in the backbone's last features, -1 to 1; of
            the most similar object of the kind, and the mean over images.
    """

    name: str
    similarity: float


def nearest(memory: Memory, features: np.ndarray, count: int) -> tuple[Neighbour, ...]:
    """The known kinds most like images (N, F) of one object, best first."""
    alike = memory.likeness(features).mean(axis=0)
    found: dict[str, float] = {}
    for place in np.argsort(-alike, kind="stable"):
        found.setdefault(_kind_of(str(memory.objects[place])), float(alike[place]))
    return tuple(Neighbour(*one) for one in list(found.items())[:count])


def write_looks(pictures: Mapping[str, np.ndarray], size_px: int, path: str | Path) -> None:
    """Write a small image of each kind.

    Args:
        pictures: of shapes or objects, (H, W, 3) uint8 each; the first one of a kind is taken.
    """
    members: dict[str, bytes] = {}
    for name in sorted(pictures):
        small = Image.fromarray(pictures[name]).resize((size_px, size_px), Image.Resampling.LANCZOS)
        buffer = io.BytesIO()
        small.save(buffer, "jpeg", quality=80)
        members.setdefault(f"{_kind_of(name)}.jpg", buffer.getvalue())
    write_bytes(path, zip_bytes(members))


def read_looks(names: Sequence[str], path: str | Path) -> list[np.ndarray]:
    """The small images (S, S, 3) uint8 of some kinds."""
    return list(read_named_pictures(path, [f"{name}.jpg" for name in names]).values())


def _kind_of(name: str) -> str:
    """The kind of a shape; an object of the dataset is one of its own."""
    try:
        return shape_of(name)[0]
    except ValueError:
        return name
