"""Sections `predict`, `plan` and `tracking`: defaults and limits of the commands, and MLflow."""

from __future__ import annotations

from typing import Literal

from grasptypes.settings.base import Between, Settings, Share, setting


class PhotoLimits(Settings):
    """Which images `grasptypes predict` accepts."""

    min_px: int = setting("shortest side", ge=1)
    max_pixels: int = setting("width times height", ge=1)
    reduce_px: int = setting("longer sides are scaled down to this", ge=32)


class PredictSettings(Settings):
    """Defaults and limits of `grasptypes predict`."""

    model: Literal[
        "general", "no_task", "task_vector", "task_in_image", "ignores_task", "e_mobilenet_v2"
    ] = setting("the predictor for unseen objects, or a model of Table I")
    labels: Literal["simulated", "published"] = setting("label source the model was trained on")
    views: int = setting("number of views of a mesh", ge=1, le=1000)
    size_m: Between = setting("extents of an object that are believed")
    mass_kg: Between = setting("masses of an object that are believed")
    photos: PhotoLimits


class PlanComparisonSettings(Settings):
    """Study of choosing types before planning."""

    sessions: int = setting("sessions per object and task", ge=1, le=1000)
    seeds: int = setting("repetitions of each predictor", ge=1, le=100)
    model: Literal["no_task", "task_vector", "task_in_image", "ignores_task"] = setting(
        "a model of Table I, which chooses types of objects that it has not seen"
    )


class PartPlanSettings(Settings):
    """Study of planning with and without the parts that a shape shows."""

    sessions: int = setting("sessions per object, task and way", ge=1, le=1000)
    trace: Share = setting("share of the contact that does not count as touching a part")
    covered: Share = setting("share of the contact on handles that leaves them free for others")


class PlanSettings(Settings):
    """Defaults and limits of `grasptypes plan`."""

    sessions: int = setting("number of ways of holding, one grasp each", ge=1, le=1000)
    min_mass_kg: float = setting("smallest mass of an object", gt=0)
    max_mass_kg: float = setting("largest mass of an object", gt=0)
    shown: int = setting("number of grasps in the image", ge=1, le=100)
    comparison: PlanComparisonSettings
    parts: PartPlanSettings


class TrackingSettings(Settings):
    """The view of all runs in MLflow."""

    database: str = setting("SQLite file", min_length=1)
    experiment: str = setting("name of the experiment", min_length=1)
    patience_s: float = setting(
        "how long to wait for a store that another process is writing", ge=0, le=3600
    )
