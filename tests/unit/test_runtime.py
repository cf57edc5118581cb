"""Every entry point computes with one thread and common instructions, whatever the user has set."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from learning import small_checkout
from PIL import Image

from grasptypes.runtime import has_home, pin_runtime, processor_features

ROOT = Path(__file__).parents[2]
USED = """
import json, os, sys
import numpy, matplotlib.pyplot, numba, threadpoolctl
from pathlib import Path
pools = threadpoolctl.threadpool_info()
found = {"threads": [pool["num_threads"] for pool in pools]}
found["kernels"] = pools[0].get("architecture")
found["backend"] = matplotlib.get_backend().lower()
found["home"] = str(Path.home())
print(json.dumps(found))
"""
# What notebooks, clusters, containers and other projects set.
HOSTILE = {
    "MPLBACKEND": "module://matplotlib_inline.backend_inline",
    "NPY_DISABLE_CPU_FEATURES": "AVX2",
    "NPY_ENABLE_CPU_FEATURES": "AVX512F",
    "OPENBLAS_CORETYPE": "SkylakeX",
    "OPENBLAS_NUM_THREADS": "7",
    "OMP_NUM_THREADS": "7",
    "MKL_NUM_THREADS": "7",
    "NUMBA_NUM_THREADS": "7",
    "NUMBA_CPU_NAME": "skylake-avx512",
    "NUMBA_CPU_FEATURES": "+avx512f",
    "ATEN_CPU_CAPABILITY": "default",
    "ONEDNN_MAX_CPU_ISA": "SSE41",
    "MKL_CBWR": "AUTO",
    "PYTHONHASHSEED": "7",
    "LP_NUM_THREADS": "7",
    "HOME": "/",
}


def used_with(variables: dict[str, str], code: str) -> dict:
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src"), **variables}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


# Layers like those of the backbone and the heads, on numbers that every machine draws alike.
NETWORK = """
import hashlib, json, numpy, torch
draw = numpy.random.default_rng(0).standard_normal
sizes = (4, 96, 14, 14), (576, 96, 1, 1), (576, 1, 3, 3)
x, wide, each = (torch.from_numpy(draw(size).astype("f")) for size in sizes)
x = x.contiguous(memory_format=torch.channels_last)
x = torch.conv2d(torch.conv2d(x, wide), each, padding=1, groups=576).relu().mean(dim=(2, 3))
heads = torch.from_numpy(draw((3, 576, 64)).astype("f"))
y = torch.bmm(x.expand(3, 4, 576), heads)
directions = torch.linalg.eigh(heads[0].T @ heads[0])[1]
digests = [hashlib.md5(z.numpy().tobytes()).hexdigest() for z in (x, y, directions)]
print(json.dumps(digests))
"""
# Of features, answers and eigenvectors.
NETWORK_DIGESTS = [
    "3e45cbd46b86029695561df9cf9c9354",
    "665cc64a9d9fba6ccf84bee688948c54",
    "12e9a3589f6b5b41c75ddbc9403d6167",
]

PINNED = "from grasptypes.runtime import pin_runtime; pin_runtime()\n" + USED


@pytest.mark.parametrize(
    "name", ["all of them", *(pytest.param(name, marks=pytest.mark.slow) for name in HOSTILE)]
)
@pytest.mark.skipif("avx2" not in processor_features(), reason="this processor has no AVX2")
def test_what_users_set_changes_nothing(name):
    found = used_with(HOSTILE if name == "all of them" else {name: HOSTILE[name]}, PINNED)
    assert set(found["threads"]) == {1}
    assert found["kernels"] == "Haswell"
    assert found["backend"] == "agg"
    assert found["home"] != "/"


@pytest.mark.skipif("avx2" not in processor_features(), reason="this processor has no AVX2")
def test_networks_compute_the_same_bytes_on_every_processor():
    code = PINNED.removesuffix(USED) + NETWORK
    assert used_with(HOSTILE, code) == NETWORK_DIGESTS
    assert used_with({}, code) == NETWORK_DIGESTS


def test_the_hostile_settings_are_hostile():
    assert used_with({"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "2"}, USED)["threads"] == [2]
    with pytest.raises(AssertionError, match="NPY_DISABLE_CPU_FEATURES"):
        used_with({name: HOSTILE[name] for name in HOSTILE if name.startswith("NPY")}, USED)


def test_commands_pin_before_numpy_is_imported():
    code = """
import contextlib, io, json, os, sys
import grasptypes.__main__
assert "numpy" not in sys.modules
with contextlib.suppress(SystemExit), contextlib.redirect_stdout(io.StringIO()):
    grasptypes.__main__.main(["predict", "--help"])
print(json.dumps({name: os.environ[name] for name in ("OMP_NUM_THREADS", "MPLBACKEND")}))
"""
    assert used_with(HOSTILE, code) == {"OMP_NUM_THREADS": "1", "MPLBACKEND": "Agg"}


# What users set for libraries and tools that answer an image or draw it, beside `HOSTILE`.
ELSEWHERE = {
    "TMPDIR": "/nonexistent",
    "MPLCONFIGDIR": "/proc/none",
    "MATPLOTLIBRC": "/nonexistent",
    "TORCH_HOME": "/proc/none",
    "NUMBA_CACHE_DIR": "/proc/none",
    "NUMBA_THREADING_LAYER": "tbb",
    "KMP_AFFINITY": "none",
    "LIBGL_ALWAYS_SOFTWARE": "0",
    "GALLIUM_DRIVER": "softpipe",
    "GIT_DIR": "/nonexistent",
    "MLFLOW_TRACKING_URI": "http://127.0.0.1:1",
    "DVC_SITE_CACHE_DIR": "/proc/none",
    "PYTHONWARNINGS": "error",
    "PYTHONOPTIMIZE": "2",
}
NOBODY = """
import os, pwd
def unknown(uid):
    raise KeyError(uid)
pwd.getpwuid = unknown
for name in ("HOME", "USER", "LOGNAME", "LNAME", "USERNAME"):
    os.environ.pop(name, None)
"""


def test_predict_answers_alike_whatever_is_set_and_for_a_user_without_an_entry(tmp_path):
    weights = small_checkout(tmp_path, {})
    image = np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    Image.fromarray(image).save(tmp_path / "cup.png")
    shown = [str(tmp_path / "cup.png"), "--task", "use", "--folder", str(tmp_path)]
    code = """
import sys
from grasptypes.__main__ import main
main(["predict", "--json", *sys.argv[1:]])
"""
    said = []
    for user, variables in (("", {}), (NOBODY, HOSTILE | ELSEWHERE)):
        drawn = tmp_path / f"drawn{len(said)}.png"
        done = subprocess.run(
            [sys.executable, "-c", user + code, *shown, "--picture", str(drawn)],
            env={**os.environ, "GRASPTYPES_BACKBONE_WEIGHTS": str(weights.path), **variables},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        said.append((done.stdout, drawn.read_bytes()))
    assert said[0] == said[1]


def test_the_workflow_pins_its_jobs():
    text = (ROOT / "Snakefile").read_text()
    assert text.index("pin_runtime()") < text.index("include:")


def test_a_home_folder_is_found_or_made_up(tmp_path):
    assert has_home({"HOME": str(tmp_path)})
    assert not has_home({"HOME": "/"})
    assert not has_home({"HOME": str(tmp_path / "none")})
    environment = {"HOME": "/"}
    pin_runtime(environment)
    assert environment["HOME"] != "/"


def test_the_processors_features_are_read(tmp_path):
    description = tmp_path / "cpuinfo"
    description.write_text("processor\t: 0\nflags\t\t: fpu avx2 fma\nbugs\t\t: none\n")
    assert processor_features(description) == {"fpu", "avx2", "fma"}
    assert processor_features(tmp_path / "none") == set()
