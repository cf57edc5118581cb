"""The kinds that the predictor for unseen objects has learned from, to compare images with.

Two questions: which known kinds look most like the images, and does anything look like them at all?
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_bytes, write_npz, zip_bytes
from grasptypes.kinds.names import shape_of
from grasptypes.predictors.general_examples import Families, family_folds
from grasptypes.predictors.general_inputs import Pictures, Projection
from grasptypes.settings.commands import KnownKindSettings

KNOWN, LOOKS = "known_kinds.npz", "known_kinds.zip"


@dataclass(frozen=True)
class Neighbour:
    """A known kind that looks like what is shown.

    Attributes:
        name: of the kind.
        similarity: cosine of the angle between both in the backbone's last features, -1 to 1.
    """

    name: str
    similarity: float


@dataclass(frozen=True)
class KnownKinds:
    """What known kinds look like to a backbone.

    Attributes:
        names: (K,) of the kinds.
        looks: (K, C) mean direction of each kind's images in the C last features.
        spread: the leading directions of all images, with equal variances.
        limit: length of a projected image beyond which it is strange.
        weights: name and checksum of the backbone's weights.
    """

    names: np.ndarray
    looks: np.ndarray
    spread: Projection
    limit: float
    weights: str

    def nearest(self, features: np.ndarray, count: int) -> tuple[Neighbour, ...]:
        """The kinds most like images (N, F) of one object, best first."""
        shown = _directions(features, self.looks.shape[1]).mean(axis=0)
        alike = self.looks @ (shown / np.linalg.norm(shown))
        best = np.argsort(-alike, kind="stable")[:count]
        return tuple(Neighbour(str(self.names[k]), float(alike[k])) for k in best)

    def strangeness(self, features: np.ndarray) -> np.ndarray:
        """How unlike all known kinds images (N, F) are, (N,); above 1 nothing known is like them.

        The Mahalanobis distance from the middle of all images of known kinds (Lee et al. 2018).
        """
        return np.asarray(np.linalg.norm(self.spread(features), axis=1) / self.limit)


def learn_kinds(
    pictures: Pictures, families: Families, settings: KnownKindSettings, weights: str, seed: int
) -> KnownKinds:
    """Describe known kinds; the limit is that of kinds which were held out with their families.

    Args:
        pictures: of all kinds and objects.
        weights: name and checksum of the backbone's weights.
        seed: of the workflow.
    """
    lengths = []
    for out in family_folds(families, settings.folds, seed):
        held = np.array([bool(families[name] & out) for name in pictures.objects])
        known = Projection.of(pictures.features[~held], settings.directions, 1.0)
        lengths.append(np.linalg.norm(known(pictures.features[held]), axis=1))
    kinds = np.array([_kind_of(name) for name in pictures.objects])
    names = np.unique(kinds)
    views = _directions(pictures.features, settings.last_features)
    means = np.stack([views[kinds == name].mean(axis=0) for name in names])
    return KnownKinds(
        names,
        means / np.linalg.norm(means, axis=1, keepdims=True),
        Projection.of(pictures.features, settings.directions, 1.0),
        float(np.quantile(np.concatenate(lengths), 1 - settings.false_alarms)),
        weights,
    )


def write_kinds(known: KnownKinds, path: str | Path) -> None:
    """Write in half precision, which is a thousandth of what tells kinds apart."""
    arrays: dict[str, np.ndarray] = {
        "looks": known.looks.astype(np.float16),
        "directions": known.spread.directions.astype(np.float16),
        "middle": known.spread.middle.astype(np.float32),
        "limit": np.array(known.limit, dtype=np.float32),
        "names": known.names.astype(np.str_),
        "weights": np.array(known.weights),
    }
    write_npz(path, arrays)


def read_kinds(path: str | Path) -> KnownKinds:
    """Read what :func:`write_kinds` wrote.

    Raises:
        InputError: the file is missing or damaged.
    """
    arrays = read_npz(path)
    try:
        return KnownKinds(
            arrays["names"],
            arrays["looks"].astype(np.float32),
            Projection(arrays["middle"], arrays["directions"].astype(np.float32)),
            float(arrays["limit"]),
            str(arrays["weights"]),
        )
    except KeyError as error:
        raise InputError(path, str(error.args[0]), "this array is missing") from error


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
    with zipfile.ZipFile(path) as archive:
        files = [io.BytesIO(archive.read(f"{name}.jpg")) for name in names]
    return [np.asarray(Image.open(file).convert("RGB")) for file in files]


def _directions(features: np.ndarray, last: int) -> np.ndarray:
    """Unit vectors of the last features, which tell kinds apart best."""
    end = features[:, -last:]
    return np.asarray(end / np.linalg.norm(end, axis=1, keepdims=True))


def _kind_of(name: str) -> str:
    """The kind of a shape; an object of the dataset is one of its own."""
    try:
        return shape_of(name)[0]
    except ValueError:
        return name
