"""Sections `grasp_types`, `published` and `replay`: the labelling rule and what it is tested on."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Name, Settings, Triple, Unique, setting

Unit = Annotated[float, Field(ge=-1, le=1)]
Width = Annotated[float, Field(gt=0, le=10, description="natural logarithm of the measure")]


class ContactSettings(Settings):
    """How contacts are measured."""

    surface_spacing_m: float = setting(
        "distance between neighbouring points on the hand", ge=0.001, le=0.05
    )
    patch_depth_m: float = setting(
        "depth over which a link's points count e times less", gt=0, le=0.05
    )
    reach_m: float = setting("gap at which a link no longer pushes", gt=0, le=0.1)
    closing_weight: float = setting(
        "length of the closing direction beside the unit normal", ge=0, le=100
    )


class Thresholds(Settings):
    """Where the tree branches."""

    palm_gap_m: float = setting("largest gap at the palm of a power grasp", gt=0, le=0.2)
    small_diameter_m: float = setting("largest enclosed diameter of a small wrap", gt=0, le=0.3)
    sideways_share: float = setting(
        "share of sideways push above which a third virtual finger acts", gt=0, le=1
    )
    large_span_m: float = setting(
        "span of the fingertips above which a wrap is large", gt=0, le=0.3
    )


class Softness(Settings):
    """Widths over which a label counts in part while fitting, natural logarithm of a measure."""

    palm_gap_m: Width
    small_diameter_m: Width
    sideways_share: Width
    large_span_m: Width


class ModelFrame(Settings):
    """How our own model of an object lies in the frame of the published poses."""

    rotation: Triple[Triple[Unit]] = setting("3 x 3, applied to the model's points")
    shift_m: Triple[Unit] = setting("after the model is stood on the ground")


class GraspTypeSettings(Settings):
    """The rule that labels a grasp."""

    contacts: ContactSettings
    thresholds: Thresholds
    fitted_on: Unique[str] = setting("objects whose published labels the thresholds were fitted on")
    softness: Softness
    own_frames: dict[Name, ModelFrame] = setting(
        "how our own model of an object lies in the frame of the published poses"
    )


class PublishedSettings(Settings):
    """The authors' table of grasps."""

    timeout_s: float = setting("how long an unreachable host may hold things up", gt=0, le=60)


class ReplaySettings(Settings):
    """The hand at the published poses."""

    object_scale: float = setting("size of the grasped object relative to its mesh", gt=0, le=10)
    surface_spacing_m: float = setting(
        "distance between neighbouring points on the hand", ge=0.001, le=0.05
    )
    limit_tolerance_rad: float = setting(
        "how far an angle may lie beyond the real hand's limit", ge=0, le=0.2
    )
