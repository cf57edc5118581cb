"""What every process runs with: one thread, common instructions, and no surprises from the user's
environment. Results then do not depend on the machine, and whoever calls `pin_runtime` gets them.
"""

from __future__ import annotations

import os
import shlex
import sys
import tempfile
from collections.abc import MutableMapping
from pathlib import Path

# What every x86 processor with AVX2 can do. Left alone, OpenBLAS, NumPy and Numba use whatever the
# machine has, and a last digit that differs becomes another grasp.
COMMON_INSTRUCTIONS = {
    "OPENBLAS_CORETYPE": "Haswell",
    "NPY_ENABLE_CPU_FEATURES": "X86_V3",
    "NUMBA_CPU_NAME": "haswell",
}
# What users set for the same libraries, and what contradicts the values above: NumPy does not start
# with features both enabled and disabled.
CONTRADICTIONS = ("NPY_DISABLE_CPU_FEATURES", "NUMBA_CPU_FEATURES")
# A job computes with one thread, so that results do not depend on how many there are and a cluster
# gets what it was asked for. Mesa counts the threads beside the one that calls it.
ONE_THREAD = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
    "LP_NUM_THREADS": "0",
}


def pin_runtime(environment: MutableMapping[str, str] = os.environ) -> None:
    """Set the variables that libraries read on import, for this process and its children.

    To be called by every entry point before NumPy is imported: what is imported already keeps its
    settings. Figures are only ever drawn to files, whatever `MPLBACKEND` a notebook has set; a user
    without a home folder gets one for caches.
    """
    environment.update(ONE_THREAD)
    environment["PYTHONHASHSEED"] = "0"
    environment["MPLBACKEND"] = "Agg"
    if not has_home(environment):
        environment["HOME"] = str(Path(tempfile.gettempdir(), f"grasptypes-{os.getuid()}"))
    if "avx2" in processor_features():
        environment.update(COMMON_INSTRUCTIONS)
        for name in CONTRADICTIONS:
            environment.pop(name, None)


def has_home(environment: MutableMapping[str, str]) -> bool:
    """Whether the user has a home folder that caches can be written to."""
    home = environment.get("HOME", "")
    if not home:
        try:
            home = str(Path.home())
        except RuntimeError:  # neither HOME nor an entry among the users, as in containers
            return False
    return home != "/" and os.access(home, os.W_OK)


def processor_features(description: Path = Path("/proc/cpuinfo")) -> set[str]:
    """Names of what an x86 processor can do; none where Linux does not tell."""
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
        # Snakemake does not quote it in the commands of jobs; there it is found on the PATH.
        sys.executable = Path(sys.executable).name
