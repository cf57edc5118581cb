"""Task-conditioned grasp types: which grasp should a robot hand use?

    import grasptypes

    mug = grasptypes.load_object("mug.stl", unit="mm")
    answer = grasptypes.Predictor.load().predict(mug, task="use")
    plan = grasptypes.Planner().plan(mug, "use", ["Power Sphere"])

Names are imported when they are used, so that `import grasptypes` is fast.

The commands and the workflow compute with one thread and the instructions that all processors with
AVX2 have, so that the last digit does not depend on the machine. A process that has imported NumPy
already keeps its own settings; to have the same, start it with

    from grasptypes.runtime import pin_runtime

    pin_runtime()
"""

from importlib import import_module
from importlib.metadata import version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from grasptypes.errors import InputError
    from grasptypes.labels.grasp import Grasp, label
    from grasptypes.labels.grasp_type import GRASP_TYPES
    from grasptypes.objects.loading import load_object
    from grasptypes.objects.object_geometry import ObjectGeometry
    from grasptypes.planning.planner import Plan, Planner
    from grasptypes.predictors.prediction import Answer, Predictor
    from grasptypes.release.reading import Release, load_release

    __version__: str

__all__ = [
    "GRASP_TYPES",
    "Answer",
    "Grasp",
    "InputError",
    "ObjectGeometry",
    "Plan",
    "Planner",
    "Predictor",
    "Release",
    "__version__",
    "label",
    "load_object",
    "load_release",
]
_HOMES = {
    "Answer": "predictors.prediction",
    "GRASP_TYPES": "labels.grasp_type",
    "Grasp": "labels.grasp",
    "InputError": "errors",
    "ObjectGeometry": "objects.object_geometry",
    "Plan": "planning.planner",
    "Planner": "planning.planner",
    "Predictor": "predictors.prediction",
    "label": "labels.grasp",
    "load_object": "objects.loading",
    "load_release": "release.reading",
    "Release": "release.reading",
}
# Libraries that a name needs, besides those that come with the package.
_EXTRAS = {"Plan": "plan", "Planner": "plan", "Answer": "predict", "Predictor": "predict"}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return version("grasptypes")
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        if name in ("Planner", "Predictor") and find_spec("torchvision"):
            # Mesa and torch's compiler each bring an LLVM, and a process that draws and predicts
            # crashes when torch's comes second.
            import_module("torchvision")
        return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    except ModuleNotFoundError as error:
        from grasptypes.extras import missing_extra

        raise missing_extra(error, _EXTRAS.get(name, "")) from error


def __dir__() -> list[str]:
    return [*globals(), *__all__]
