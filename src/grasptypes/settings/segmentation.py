"""Section `segmentation`: parts and roles from shape."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Many, Settings, Share, setting


class DescriptorSettings(Settings):
    """Numbers that describe a point of a surface."""

    points: int = setting("points that stand for the object's surface", ge=256, le=16384)
    spacing_m: float = setting("points nearer than this are on the same face", gt=0, le=0.02)
    radii_m: Many[Annotated[float, Field(gt=0, le=0.2)]] = setting("radii of neighbourhoods")
    local_share: float = setting(
        "radius of one more, as a share of the object's length", gt=0, le=1
    )
    spin_bins: int = setting("bins of a spin image beside the normal", ge=2, le=16)
    stations: int = setting("stations along the object's length", ge=4, le=64)


class RoleSampleSettings(Settings):
    """Points on shapes of kinds, from which the network learns."""

    shapes: int = setting("shapes of each kind", ge=1, le=99)
    points: int = setting("points of each shape", ge=64, le=8192)
    stretch: float = setting("largest factor along each axis, and its inverse", ge=1, le=2)
    roughness_m: float = setting("standard deviation of points about the surface", ge=0, le=0.01)
    normal_noise: float = setting("standard deviation of normals, per component", ge=0, le=1)
    hole_share: float = setting("largest hole, as a share of the surface", ge=0, le=0.9)


class RoleTrainingSettings(Settings):
    """Training of the network that names roles."""

    width: int = setting("units of each layer", ge=8, le=1024)
    epochs: int = setting("passes over all shapes", ge=1)
    batch: int = setting("shapes in a step", ge=1)
    learning_rate: float = setting("largest step of the schedule", gt=0, le=1)
    weight_decay: float = setting("of AdamW", ge=0, le=10)
    dropout: float = setting("share of units that are left out of a step", ge=0, lt=1)
    noise: float = setting("added to descriptors, in standard deviations", ge=0, le=5)
    balance: float = setting("power of a role's frequency by which it counts less", ge=0, le=1)
    label_smoothing: float = setting("share of a label that goes to all other roles", ge=0, lt=1)
    folds: int = setting("groups of families that are held out in turn", ge=2, le=20)


class ForestSettings(Settings):
    """The random forest that the network is compared with."""

    trees: int = setting("number of trees", ge=1, le=10000)
    points: int = setting("points of each shape from which it learns", ge=1, le=8192)
    least_points: int = setting("points in the smallest leaf", ge=1, le=10000)


class PartSettings(Settings):
    """Parts and roles of a mesh that names none."""

    descriptors: DescriptorSettings
    neighbours: int = setting("neighbours of each point on the surface", ge=3, le=64)
    smoothing_steps: int = setting("how often neighbours are listened to", ge=0, le=1000)
    own_share: float = setting("weight of a point itself against its neighbours", gt=0, le=1)
    smallest_share: float = setting("smallest part, as a share of the surface", ge=0, le=0.5)
    minor_share: Share = setting("smallest part that is held, relative to others with its role")
    same_colour: int = setting("largest difference between levels of the same colour", ge=0, le=255)


class SegmentationSettings(PartSettings):
    """The same, with how it is learned and tested."""

    samples: RoleSampleSettings
    training: RoleTrainingSettings
    forest: ForestSettings
