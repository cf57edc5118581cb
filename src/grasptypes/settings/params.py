"""params.yaml as a whole: every section, read once and checked once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, model_validator

from grasptypes.errors import InputError
from grasptypes.settings.base import MisplacedError, Name, Settings, Unique, setting
from grasptypes.settings.commands import PlanSettings, PredictSettings, TrackingSettings
from grasptypes.settings.contact_maps import ContactMapSettings
from grasptypes.settings.demonstrations import DemonstrationSettings
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.grasp_types import GraspTypeSettings, PublishedSettings, ReplaySettings
from grasptypes.settings.holds import HoldFitSettings
from grasptypes.settings.kinds import KindSettings
from grasptypes.settings.many_tasks import LearningCurveSettings, ManyTaskSettings
from grasptypes.settings.objects import ObjectSettings, TaskSettings
from grasptypes.settings.physics import GraspTestSettings
from grasptypes.settings.predictors import (
    NO_TASK,
    BackboneSettings,
    FeatureSettings,
    FoldSettings,
    GeneralisationSettings,
    PredictorSettings,
)
from grasptypes.settings.renders import ContactPictureSettings, GallerySettings, RenderSettings
from grasptypes.settings.robustness import RobustnessSettings
from grasptypes.settings.segmentation import SegmentationSettings
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.settings.tasks import TASKS, read_tasks
from grasptypes.yaml_files import read_yaml

PARAMS = "params.yaml"


def _is_a_task(name: str) -> str:
    if name == NO_TASK:
        raise ValueError(f"'{name}' stands for no task: choose another name")
    if name not in read_tasks():
        raise ValueError(f"'{name}' is not described in {TASKS.name}: {', '.join(read_tasks())}")
    return name


class Params(Settings):
    """Parameters of the grasptypes workflow."""

    seed: int = setting("integer, part of the key of every random draw", ge=0)
    tasks: dict[Annotated[Name, AfterValidator(_is_a_task)], TaskSettings] = setting(
        "what the object is grasped for, in the order of task vectors", min_length=1
    )
    hand: str = setting(
        "a hand that comes with the package, or a folder with a hand of your own", min_length=1
    )
    objects: ObjectSettings
    kinds: KindSettings
    segmentation: SegmentationSettings
    contact_maps: ContactMapSettings
    published: PublishedSettings
    replay: ReplaySettings
    contact_pictures: ContactPictureSettings
    hold_fit: HoldFitSettings
    synthesis: SynthesisSettings
    physics: GraspTestSettings
    robustness: RobustnessSettings
    gallery: GallerySettings
    grasp_types: GraspTypeSettings
    renders: RenderSettings
    backbone: BackboneSettings
    features: FeatureSettings
    folds: FoldSettings
    labels: Unique[Literal["simulated", "published"]] = setting(
        "label sources to make tables for", min_length=1
    )
    predictors: PredictorSettings
    generalisation: GeneralisationSettings
    demonstrations: DemonstrationSettings
    many_tasks: ManyTaskSettings
    learning_curve: LearningCurveSettings
    predict: PredictSettings
    plan: PlanSettings
    tracking: TrackingSettings
    general: GeneralSettings

    @property
    def colour_shifts(self) -> dict[str, int]:
        """Colour shift that encodes each task."""
        return {name: task.colour_shift for name, task in self.tasks.items()}

    @model_validator(mode="after")
    def _tasks_agree(self) -> Self:
        shown: dict[int, str] = {}
        for name, task in self.tasks.items():
            other = shown.setdefault(task.colour_shift, name)
            if other != name:
                raise MisplacedError(
                    f"tasks.{name}.colour_shift",
                    f"{task.colour_shift} is also that of {other}: no image tells them apart",
                )
        for name, own in self.objects.own.items():
            for unknown in own.contact_maps.keys() - self.tasks.keys():
                key = f"objects.own.{name}.contact_maps"
                raise MisplacedError(key, f"'{unknown}' is not one of {', '.join(self.tasks)}")
        return self


def read_params(path: str | Path) -> Params:
    """Read the parameters of a file.

    Raises:
        InputError: the file cannot be read, or has a wrong key; names the first one.
    """
    return Params.check(read_yaml(path), path)


def default_params_path() -> Path:
    """The parameters that come with the package: in a wheel its own, else those of the checkout."""
    package = Path(__file__).parents[1]
    installed = package / PARAMS
    return installed if installed.is_file() else package.parents[1] / PARAMS


def checkout_params(folder: str | Path | None = None) -> Params:
    """The parameters of a checkout.

    Args:
        folder: root of the checkout; None stands for the current folder or, if it has no
            parameters, for those that come with the package.

    Raises:
        InputError: the folder has no parameters, or they are invalid.
    """
    if folder is None:
        here = Path(PARAMS)
        return read_params(here if here.is_file() else default_params_path())
    path = Path(folder, PARAMS)
    if not path.is_file():
        raise InputError(path, "", "no such file; name a checkout as the folder (--folder)")
    return read_params(path)
