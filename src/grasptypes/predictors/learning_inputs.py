"""Reading the inputs of predictors, and the record of the backbone that made them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_json
from grasptypes.predictors.features import encodings, read_pictures, shift_colours
from grasptypes.predictors.weights import Weights, find_weights


@dataclass(frozen=True)
class BackboneRecord:
    """The backbone in use, as shown in every table, run and figure.

    Attributes:
        backbone: name of the network.
        weights: name and checksum of its weights.
        sha256: checksum of the weights file.
        input_px: size of its input image.
    """

    backbone: str
    weights: str
    sha256: str
    input_px: int


def write_backbone_record(weights: Weights, input_px: int, path: str | Path) -> None:
    """Record the weights that were found, without their path on this machine."""
    record = BackboneRecord(weights.backbone, weights.name, weights.sha256, input_px)
    write_json(path, asdict(record))


def read_backbone_record(path: str | Path) -> BackboneRecord:
    """Read the record.

    Raises:
        InputError: the file is not a record.
    """
    try:
        return BackboneRecord(**json.loads(Path(path).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise InputError(path, "", f"not a backbone record: {error}") from error


def recorded_weights(record: BackboneRecord) -> Weights:
    """The recorded weights on this machine, without network access.

    Raises:
        InputError: the weights found here are not the recorded ones.
    """
    weights = find_weights(timeout_s=0)
    if weights.sha256 != record.sha256:
        raise InputError(
            weights.path,
            "",
            f"is not the recorded {record.weights} of {record.backbone}; "
            "remove data/backbone.json to use it",
        )
    return weights


def read_inputs(
    paths: Iterable[str | Path], tasks: Mapping[str, int]
) -> dict[str, dict[str, np.ndarray]]:
    """Object to encoding to one input per view, from files named after their objects.

    Args:
        paths: features (.npz), or archives of images (.zip) that are encoded here.
        tasks: colour shift of each task, in the order of the task vector.

    Returns:
        arrays (V, F) float32 or (V, H, W, 3) uint8.
    """
    inputs = {}
    for path in map(Path, paths):
        if path.suffix == ".npz":
            inputs[path.stem] = read_npz(path)
        else:
            pictures = read_pictures(path)
            shifts = encodings(tasks).items()
            inputs[path.stem] = {name: shift_colours(pictures, shift) for name, shift in shifts}
    return inputs
