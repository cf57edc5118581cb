"""Sections `predict`, `plan` and `tracking`: defaults and limits of the commands, and MLflow."""

from __future__ import annotations

from typing import Literal

from grasptypes.settings.base import Settings, setting


class PhotoLimits(Settings):
    """Which images `grasptypes predict` accepts."""

    min_px: int = setting("shortest side", ge=1)
    max_pixels: int = setting("width times height", ge=1)
    reduce_px: int = setting("longer sides are reduced to this", ge=32)


class PredictSettings(Settings):
    """Defaults and limits of `grasptypes predict`."""

    model: Literal["no_task", "task_vector", "task_in_image", "ignores_task"] = setting(
        "a model of Table I"
    )
    labels: Literal["simulated", "published"] = setting("labels it was trained on")
    views: int = setting("views of a mesh", ge=1, le=1000)
    photos: PhotoLimits


class PlanComparisonSettings(Settings):
    """What choosing types first buys."""

    sessions: int = setting("sessions an object and task", ge=1, le=1000)
    seeds: int = setting("repetitions of each predictor", ge=1, le=100)


class PlanSettings(Settings):
    """Defaults and limits of `grasptypes plan`."""

    sessions: int = setting("ways of holding, one grasp each", ge=1, le=1000)
    min_mass_kg: float = setting("smallest mass of an object", gt=0)
    max_mass_kg: float = setting("largest mass of an object", gt=0)
    shown: int = setting("best grasps on the picture", ge=1, le=100)
    comparison: PlanComparisonSettings


class TrackingSettings(Settings):
    """The view of all runs in MLflow."""

    database: str = setting("SQLite file", min_length=1)
    experiment: str = setting("name under which the runs stand", min_length=1)
    patience_s: float = setting(
        "how long to wait for a store that another process is writing", ge=0, le=3600
    )
