"""Sections `contact_maps` and `contact_evidence`: how people hold and touch the objects."""

from __future__ import annotations

from typing import Literal

from grasptypes.settings.base import Many, Name, Settings, Share, Unique, setting
from grasptypes.settings.roles import RoleName
from grasptypes.settings.tasks import Factor, Grip

Measure = Literal["length", "width", "thickness", "compactness", "load_n"]


class HandLengths(Settings):
    """One of equally large groups of people."""

    hand_length_m: float = setting("mean length of the hand", ge=0.05, le=0.5)
    hand_length_sd_m: float = setting("its standard deviation", ge=0, le=0.05)


class HandProportions(Settings):
    """Measures of the hand as shares of its length."""

    breadth: float = setting("across the bases of the four fingers", gt=0, le=2)
    finger_reach: float = setting("from the palm's centre to a fingertip", gt=0, le=2)
    thumb_reach: float = setting("from the palm's centre to the tip of the thumb", gt=0, le=2)
    palm_half: float = setting("half of the palm area that touches", gt=0, le=2)
    palm_radius: float = setting("palm's patch when the fingers are spread", gt=0, le=2)
    finger_half_width: float = setting("half a finger's breadth", gt=0, le=2)
    pad_radius: float = setting("radius of a fingertip's patch", gt=0, le=2)
    span: float = setting(
        "maximum distance from the centre of a precision grip to a fingertip", gt=0, le=2
    )
    softness: float = setting("depth by which skin gives way", gt=0, le=2)


class PlacementSettings(Settings):
    """How people deviate from their hold."""

    tilt_sd_rad: float = setting(
        "tilt of the palm about either axis, standard deviation", ge=0, le=1.6
    )
    roll_sd_rad: float = setting(
        "roll of the hand about its approach, standard deviation", ge=0, le=1.6
    )
    slice_m: float = setting(
        "half the thickness of the slice on which the hand is centred", gt=0, le=0.1
    )
    depth_m: float = setting("depth of the fingertips below a rim", gt=0, le=0.2)


class MeasuredMapSettings(Settings):
    """How a map measured on an own object becomes a probability and sessions."""

    coldest: float = setting("probability at the coldest visible vertex", gt=0, lt=0.5)
    warmest: float = setting("probability at the warmest vertex", gt=0.5, lt=1)
    max_gap_m: float = setting(
        "maximum distance from a surface point to its nearest vertex of the scan", gt=0, le=0.05
    )
    min_seen_share: Share = setting("smallest share of the surface points that the scan must show")
    placements: int = setting("placements that a person compares", ge=1, le=10000)
    sharpness: float = setting(
        "power of a placement's agreement with the map that weights it", ge=0, le=100
    )


class HoldGroup(Settings):
    """Roles that people hold alike."""

    roles: Unique[RoleName] = setting("roles of the parts", min_length=1)
    grips: dict[Grip, Factor] = setting("prior of each grip, relative to the others", min_length=1)
    fitted: bool = setting("whether the priors are fitted to published labels")
    held_at: Literal["task", "centre_of_mass"] = setting(
        "where along its axis: where the task says, or near the centre of mass"
    )
    reason: str = setting("why, or the evidence", min_length=1)


class Fit(Settings):
    """How well grips fit by size or weight: a factor (measure / at) ** power from `at` upwards."""

    grips: Unique[Grip] = setting("grips it applies to", min_length=1)
    groups: Unique[Name] = setting("groups it applies to; empty: all", default=())
    measure: Measure = setting("what is measured")
    at: float = setting("value up to which the factor is 1", gt=0, le=100)
    expected: float = setting("exponent without any labels", ge=-10, le=10)
    power: float = setting(
        "exponent fitted to published labels; negative: the larger, the worse", ge=-10, le=10
    )
    reason: str = setting("why, or the evidence", min_length=1)


class HoldTable(Settings):
    """How people hold parts, by role, size and weight."""

    groups: dict[Name, HoldGroup] = setting("groups of roles", min_length=1)
    area_power: float = setting("exponent of a place's share of the surface", ge=0, le=2)
    rarest: Share = setting("grips that a smaller share of people would use are left out")
    fits: Many[Fit] = setting("how grips depend on size and weight")


class ContactMapSettings(Settings):
    """How contact maps are drawn."""

    sessions: int = setting("ways of holding per object and task", ge=1, le=1000)
    population: int = setting("virtual people whose mean is the population's map", ge=1, le=10000)
    points: int = setting("number of surface points of a map", ge=100, le=100000)
    threshold: float = setting("contact above which a point counts as touched (0 to 1)", gt=0, lt=1)
    tries: int = setting("placements that a person tries before giving up", ge=1, le=1000)
    people: Many[HandLengths] = setting("equally large groups of people", min_length=1)
    hand: HandProportions
    placement: PlacementSettings
    measured: MeasuredMapSettings


class HoldFitSettings(Settings):
    """How the free numbers of the table of holds are fitted to published labels."""

    grasps: float = setting("grasps of an object and task that count as independent", gt=0, le=100)
    label_noise: Share = setting("share of grasps whose type says nothing")
    prior_sd: float = setting(
        "standard deviation of the priors' natural logarithms without labels", gt=0, le=10
    )
    power_sd: float = setting("standard deviation of the exponents without labels", gt=0, le=10)
    relatives: Many[Unique[str]] = setting("objects that are left out together")


class ContactEvidenceSettings(Settings):
    """How the places that published poses touch are measured."""

    hand_spacing_m: float = setting(
        "distance between neighbouring points on the hand", ge=0.001, le=0.05
    )
    touch_m: float = setting("surfaces closer than this touch", gt=0, le=0.05)
