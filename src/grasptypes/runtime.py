"""The settings that every process runs with: one thread, a common instruction set, and nothing from
the user's environment that changes results. Every entry point calls `pin_runtime`.
"""

from __future__ import annotations

import os
import shlex
import sys
import tempfile
from collections.abc import MutableMapping
from pathlib import Path

# What every x86 processor with AVX2 supports. By default, OpenBLAS, NumPy, Numba, and torch with
# oneDNN and MKL use whatever the machine has, and a difference in the last digit leads to another
# grasp. MKL promises the same digits on processors of all makers only in this mode.
COMMON_INSTRUCTIONS = {
    "OPENBLAS_CORETYPE": "Haswell",
    "NPY_ENABLE_CPU_FEATURES": "X86_V3",
    "NUMBA_CPU_NAME": "haswell",
    "ATEN_CPU_CAPABILITY": "avx2",
    "ONEDNN_MAX_CPU_ISA": "AVX2",
    "MKL_CBWR": "COMPATIBLE",
}
# User settings of the same libraries that contradict the values above: NumPy does not start with
# features both enabled and disabled.
CONTRADICTIONS = ("NPY_DISABLE_CPU_FEATURES", "NUMBA_CPU_FEATURES")
# Jobs compute with one thread, so that results do not depend on their number and jobs use what they
# requested from a cluster. Mesa counts the threads in addition to the calling one.
ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
    "LP_NUM_THREADS": "0",
}


def pin_runtime(environment: MutableMapping[str, str] = os.environ) -> None:
    """Set the variables that libraries read on import, for this process and its children.

    Every entry point must call this before NumPy is imported, since imported libraries keep their
    settings. Figures are only drawn to files, so `MPLBACKEND` is overridden too, and pyrender needs
    assertions (see `renders.gl_platform`). A user without a home folder gets a temporary one for
    caches.
    """
    environment.update(ONE_THREAD)
    environment["PYTHONHASHSEED"] = "0"
    environment["MPLBACKEND"] = "Agg"
    environment.pop("PYTHONOPTIMIZE", None)
    if not has_home(environment):
        environment["HOME"] = str(Path(tempfile.gettempdir(), f"grasptypes-{os.getuid()}"))
    if "avx2" in processor_features():
        environment.update(COMMON_INSTRUCTIONS)
        for name in CONTRADICTIONS:
            environment.pop(name, None)


def has_home(environment: MutableMapping[str, str]) -> bool:
    """Whether the user has a writable home folder for caches."""
    home = environment.get("HOME", "")
    if not home:
        try:
            home = str(Path.home())
        except RuntimeError:  # neither HOME nor a user entry, as in containers
            return False
    return home != "/" and os.access(home, os.W_OK)


def processor_features(description: Path = Path("/proc/cpuinfo")) -> set[str]:
    """Feature names of the x86 processor; empty where Linux does not list them."""
    if not description.is_file():
        return set()
    lines = description.read_text().splitlines()
    return {name for line in lines if line.startswith("flags") for name in line.split()[2:]}


def use_this_checkout(root: str | Path) -> None:
    """Make the jobs of a workflow run this checkout's code with the Python that runs Snakemake."""
    paths = [str(Path(root) / "src"), os.environ.get("PYTHONPATH", "")]
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, paths))
    os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    if shlex.quote(sys.executable) != sys.executable:
        # Snakemake does not quote this path in job commands; they find the name on the PATH.
        sys.executable = Path(sys.executable).name
