"""Sections `predict`, `plan` and `tracking`: defaults and limits of the commands, and MLflow."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator

from grasptypes.settings.base import (
    Between,
    Name,
    Pair,
    Settings,
    Share,
    Unique,
    setting,
    upwards,
)
from grasptypes.settings.roles import RoleName


class PhotoLimits(Settings):
    """Which images `grasptypes predict` accepts."""

    min_px: int = setting("shortest side", ge=1)
    max_pixels: int = setting("width times height", ge=1)
    reduce_px: int = setting("longer sides are scaled down to this", ge=32)


class DepthLimits(Settings):
    """Which depth images `grasptypes predict` accepts."""

    range_m: Between = setting("median distance of the object from the camera")
    max_holes: Share = setting("largest share of the object's pixels without depth")
    rise_m: float = setting("least height of an object above what it stands on", gt=0)
    outliers: Share = setting("share of the nearest and of the farthest pixels that do not count")


class CloudSettings(Settings):
    """Which point clouds `grasptypes predict` accepts, and how it draws them."""

    points: Annotated[Pair[int], AfterValidator(upwards)] = setting("number of points")
    cells: int = setting("cells along the longest extent of the surface drawn", ge=8, le=256)
    ball: float = setting("radius of each point's ball, in distances to its neighbour", gt=0)


class ForegroundSettings(Settings):
    """How objects are counted in an image of which no part is named."""

    size_px: int = setting("longer sides are scaled down to this", ge=16, le=1024)
    edge: float = setting("change of colour that ends the ground, levels per pixel", gt=0)
    ground: Share = setting("smallest share of the image that is ground, else nothing is said")
    empty: Share = setting("share of ground above which an image without objects is empty")
    least: Share = setting("smallest share of the image that an object covers")
    relative: Share = setting("smallest size of an object, relative to the largest one")
    far: Share = setting("share of the image's sides below which a single object is too small")


class ExplanationSettings(Settings):
    """How `--explain` finds what in an image spoke for a type."""

    window: Share = setting("side of the square that is hidden, as a share of the image")
    steps: int = setting("places of the square along each side", ge=2, le=64)
    blur: Share = setting("standard deviation of the blur that hides, as a share of the image")


class KnownKindSettings(Settings):
    """How images are compared with known kinds."""

    shown: int = setting("most similar kinds in an answer", ge=1, le=100)
    picture_px: int = setting("side of the small images of kinds", ge=16, le=256)


class DemoSettings(Settings):
    """The page of `grasptypes demo`."""

    max_upload_mb: float = setting("largest image", gt=0, le=1000)


class PredictSettings(Settings):
    """Defaults and limits of `grasptypes predict`."""

    model: Literal[
        "general", "no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2"
    ] = setting("the predictor for unseen objects, or a model of Table I")
    labels: Literal["simulated", "published"] = setting("label source the model was trained on")
    views: int = setting("number of views of a mesh", ge=1, le=1000)
    size_m: Between = setting("extents of an object that are believed")
    mass_kg: Between = setting("masses of an object that are believed")
    batch: int = setting("images that the backbone sees at once", ge=1, le=1000)
    photos: PhotoLimits
    depth: DepthLimits
    clouds: CloudSettings
    foreground: ForegroundSettings
    explanation: ExplanationSettings
    known_kinds: KnownKindSettings
    demo: DemoSettings


class PlanComparisonSettings(Settings):
    """Study of choosing types before planning."""

    sessions: int = setting("sessions per object and task", ge=1, le=1000)
    seeds: int = setting("repetitions of each predictor of Table I", ge=1, le=100)
    model: Literal["general", "no_task", "task_vector", "task_in_image", "ignores_task"] = setting(
        "`general` or a model of Table I, which chooses types of objects that it has not seen"
    )


class PartPlanSettings(Settings):
    """Study of planning with and without the parts that a shape shows."""

    sessions: int = setting("sessions per object, task and way", ge=1, le=1000)
    covered: Share = setting("share of the contact on handles that leaves them free for others")


class PlanSettings(Settings):
    """Defaults and limits of `grasptypes plan`."""

    sessions: int = setting("number of ways of holding, one grasp each", ge=1, le=1000)
    min_mass_kg: float = setting("smallest mass of an object", gt=0)
    max_mass_kg: float = setting("largest mass of an object", gt=0)
    shown: int = setting("number of grasps in the image", ge=1, le=100)
    offered: dict[Name, list[Unique[RoleName]]] = setting(
        "by task, roles that a plan leaves free: the first list that leaves something to hold; its "
        "hands keep off hazards too"
    )
    trace: Share = setting("share of the contact that does not count as touching a part")
    comparison: PlanComparisonSettings
    parts: PartPlanSettings


class TrackingSettings(Settings):
    """The view of all runs in MLflow."""

    database: str = setting("SQLite file", min_length=1)
    experiment: str = setting("name of the experiment", min_length=1)
    patience_s: float = setting(
        "how long to wait for a store that another process is writing", ge=0, le=3600
    )
