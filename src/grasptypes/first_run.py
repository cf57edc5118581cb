"""What takes longer the first time: said before it happens."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from grasptypes.predictors.weights import DOWNLOAD_URL, WEIGHTS_VARIABLE, torch_cache

# Where Numba keeps machine code: next to the module, or in a cache of the user or of their choice.
SYNTHESIS = Path(__file__).parent / "synthesis"
DOWNLOAD_MB = 14


def compiling(environment: Mapping[str, str] = os.environ) -> list[str]:
    """A line if the search for grasps has not been compiled on this machine yet; else nothing."""
    places = [SYNTHESIS / "__pycache__", Path("~/.cache/numba").expanduser()]
    if named := environment.get("NUMBA_CACHE_DIR"):
        places = [Path(named)]
    if any(next(place.rglob("energy.*.nbi"), None) for place in places):
        return []
    return ["first run: functions are compiled once, which takes about half a minute"]


def downloading(record: str | Path, environment: Mapping[str, str] = os.environ) -> list[str]:
    """A line if a run is going to download the backbone's weights; else nothing.

    Args:
        record: file that says which weights this folder uses, once that is known.
    """
    cached = torch_cache() / Path(DOWNLOAD_URL).name
    if environment.get(WEIGHTS_VARIABLE) or cached.is_file() or Path(record).exists():
        return []
    return [f"first run: {DOWNLOAD_MB} MB of weights are downloaded to {cached.parent}"]
