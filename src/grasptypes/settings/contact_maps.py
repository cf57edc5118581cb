"""Section `contact_maps`: how people hold and touch the objects."""

from __future__ import annotations

from grasptypes.settings.base import Many, Settings, Share, setting


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
