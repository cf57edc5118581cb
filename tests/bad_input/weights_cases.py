"""Mistakes in the file of backbone weights."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import torch
from case import Case, Content, script

from grasptypes.predictors.weights import WEIGHTS_VARIABLE


class Code:
    """A pickle that leaves a file behind if it is ever loaded."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Path.touch, (Path("ran"),)


def weights(what: str, content: Content | None, *names: str, chosen: str = "default") -> Case:
    """A file that GRASPTYPES_BACKBONE_WEIGHTS names."""
    files = {} if content is None else {"net.pth": content}
    prepare = script("prepare_backbone", "prepare_backbone", "backbone.json", chosen, 0, 64)
    return Case("weights", what, files, prepare, ("net.pth", *names), {WEIGHTS_VARIABLE: "net.pth"})


def saved(content: Callable[[], object]) -> Callable[[Path], None]:
    """A file as torch writes it."""
    return lambda path: torch.save(content(), path)


def network() -> dict[str, torch.Tensor]:
    """A whole network's tensors, random."""
    from torchvision.models import mobilenet_v2

    return mobilenet_v2().state_dict()


def truncated(path: Path) -> None:
    """Half a file."""
    torch.save({"a": torch.zeros(1000)}, path)
    path.write_bytes(path.read_bytes()[:700])


def with_nan() -> dict[str, torch.Tensor]:
    """The network with one number that is none."""
    state = network()
    state["classifier.1.bias"][3] = float("nan")
    return state


CASES = [
    weights("missing", None, WEIGHTS_VARIABLE, "not a file"),
    weights("a folder", Path.mkdir, WEIGHTS_VARIABLE, "not a file"),
    weights(
        "other weights than those of the results", b"net", WEIGHTS_VARIABLE, "0a1b", chosen="0a1b"
    ),
    weights("empty", b"", "not a file of tensors"),
    weights("truncated", truncated, "not a file of tensors"),
    weights("text", "weights\n", "not a file of tensors"),
    weights("a pickle with code", pickle.dumps(Code(), protocol=2), "not a file of tensors"),
    weights("a pickle with code, as torch writes it", saved(Code), "not a file of tensors"),
    weights("a list", saved(lambda: [torch.zeros(1)]), "not a state dict"),
    weights("numbers instead of tensors", saved(lambda: {"a": 1}), "not a state dict"),
    weights("numbers for names", saved(lambda: {1: torch.zeros(1)}), "not a state dict"),
    weights("sparse tensors", saved(lambda: {"a": torch.eye(3).to_sparse()}), "not a state dict"),
    weights("another network", saved(lambda: {"a": torch.zeros(3)}), "not weights of mobilenet_v2"),
    weights(
        "wrong shapes",
        saved(lambda: network() | {"classifier.1.bias": torch.zeros(3)}),
        "not weights of mobilenet_v2",
        "classifier.1.bias",
    ),
    weights("NaN", saved(with_nan), "classifier.1.bias", "not finite"),
]
