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
        "depth over which the weight of a link's points falls by a factor of e", gt=0, le=0.05
    )
    reach_m: float = setting("gap above which a link no longer pushes", gt=0, le=0.1)
    closing_weight: float = setting(
        "weight of the closing direction relative to the unit normal", ge=0, le=100
    )


class Thresholds(Settings):
    """Thresholds of the decision tree."""

    palm_gap_m: float = setting("largest palm gap of a power grasp", gt=0, le=0.2)
    small_diameter_m: float = setting("largest enclosed diameter of a small wrap", gt=0, le=0.3)
    sideways_share: float = setting(
        "sideways share above which there is a third virtual finger", gt=0, le=1
    )
    large_span_m: float = setting("fingertip span above which a wrap is large", gt=0, le=0.3)


class LabellingRule(Settings):
    """The rule that labels a grasp: measures of its contacts, and the tree's thresholds."""

    contacts: ContactSettings
    thresholds: Thresholds
    finger_length_m: float = setting(
        "length of the fingers of the hand on whose grasps the thresholds were fitted", gt=0, le=1
    )


class Softness(Settings):
    """Widths over which a label counts in part while fitting, in natural logarithms."""

    palm_gap_m: Width
    small_diameter_m: Width
    sideways_share: Width
    large_span_m: Width


class ModelFrame(Settings):
    """Placement of our own model of an object in the frame of the published poses."""

    rotation: Triple[Triple[Unit]] = setting("3 x 3, applied to the model's points")
    shift_m: Triple[Unit] = setting("after placing the model on the ground")


class GraspTypeSettings(LabellingRule):
    """The rule, and how it was fitted."""

    fitted_on: Unique[str] = setting("objects whose published labels the thresholds were fitted on")
    softness: Softness
    own_frames: dict[Name, ModelFrame] = setting(
        "placement of our own object models in the frame of the published poses"
    )


class PublishedSettings(Settings):
    """The authors' table of grasps."""

    hand: str = setting("the hand of the authors' grasps", min_length=1)
    timeout_s: float = setting("how long to wait for an unreachable host", gt=0, le=60)


class ReplaySettings(Settings):
    """The hand at the published poses."""

    object_scale: float = setting("size of the grasped object relative to its mesh", gt=0, le=10)
    surface_spacing_m: float = setting(
        "distance between neighbouring points on the hand", ge=0.001, le=0.05
    )
    limit_tolerance_rad: float = setting(
        "how far an angle may exceed the real hand's limit", ge=0, le=0.2
    )
    limit_tolerance_m: float = setting(
        "how far the position of a prismatic joint may", ge=0, le=0.02
    )
