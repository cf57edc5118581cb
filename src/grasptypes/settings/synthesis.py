"""Section `synthesis`: the search for grasps (ContactGrasp, Brahmbhatt et al. 2019, section IV)."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Many, Pair, Settings, setting

Bound = Annotated[float, Field(ge=-1, le=1)]


class HandSampling(Settings):
    """How finely the hand is sampled."""

    finger_spacing_m: float = setting(
        "distance between points on the fingers during the search", ge=0.002, le=0.02
    )
    base_spacing_m: float = setting("the same on palm and knuckles", ge=0.002, le=0.03)
    check_spacing_m: float = setting(
        "distance between points of the final check", ge=0.002, le=0.02
    )
    grid_spacing_m: float = setting("spacing of the links' distance grids", ge=0.001, le=0.01)


class ShapeRanges(Settings):
    """What the shape of a hand keeps to with a grip; least and most of each measure."""

    palm_gap_m: Pair[Bound] = setting("gap between palm and object")
    enclosed_diameter_m: Pair[Bound] = setting("diameter of the circle in the fingers")
    sideways_share: Pair[Bound] = setting("share of the push along the palm's x axis")


class Grip(Settings):
    """How a grip of the affinity table is done with this hand."""

    spreads_rad: Many[Annotated[float, Field(ge=0, le=3.1416)]] = setting(
        "spreads to choose from", min_length=1
    )
    palm_distances_m: Many[Annotated[float, Field(ge=0, le=0.2)]] = setting(
        "from the palm to the point aimed at", min_length=1
    )
    shape: ShapeRanges


class Grips(Settings):
    """The grips of the affinity table."""

    wrap: Grip
    enclose: Grip
    tripod: Grip
    pinch: Grip
    rim: Grip

    def named(self, name: str) -> Grip:
        """The grip of this name."""
        grip: Grip = getattr(self, name)
        return grip


class CandidateSettings(Settings):
    """How candidates are drawn."""

    number: int = setting("candidates a session", ge=1, le=100000)
    follow_share: float = setting("share that follows the person's own placement", ge=0, le=1)
    position_sd_m: float = setting("deviation of the point aimed at", ge=0, le=0.1)
    tilt_sd_rad: float = setting("deviation of approach and roll", ge=0, le=1.6)
    rolls: int = setting("evenly spaced rolls of candidates that do not follow", ge=1, le=360)
    start_m: float = setting("distance before the object at which hands start", ge=0.1, le=2)
    back_offs_m: Many[Annotated[float, Field(ge=0, le=0.2)]] = setting(
        "how far hands draw back from where they touched", min_length=1
    )
    grips: Grips


class ClosingSettings(Settings):
    """When a moving link stops."""

    touch_m: float = setting("distance between touching surfaces", gt=0, le=0.005)


class EnergySettings(Settings):
    """ContactGrasp's energy."""

    contact_threshold: float = setting("contact from which a point attracts", ge=0, le=1)
    attraction_points: int = setting("attracting points at most", ge=1, le=10000)
    repulsion_points: int = setting("repelling points at most", ge=0, le=10000)
    attraction_weight: float = setting(
        "of a metre between hand and an attracting point", ge=0, le=100000
    )
    repulsion_weight: float = setting(
        "of a metre between hand and a repelling point", ge=0, le=100000
    )
    thumb_weight: float = setting(
        "of a metre between finger 3 and the nearest attracting point", ge=0, le=100000
    )
    penetration_weight: float = setting("of a metre of hand in object", ge=0, le=100000)
    self_collision_weight: float = setting("of a metre of link in link", ge=0, le=100000)
    range_m: float = setting("distance from which terms stay constant", gt=0, le=0.02)
    repulsion_offset_m: float = setting(
        "how far the nearest hand point may lie from a repelling point's normal", ge=0, le=0.1
    )


class EquilibriumSettings(Settings):
    """Balance of the touching points."""

    friction: float = setting("Coulomb coefficient it is judged with", ge=0, le=5)
    cone_edges: int = setting("edges of a friction pyramid", ge=3, le=64)
    contact_m: float = setting("gap up to which points touch", gt=0, le=0.01)
    iterations: int = setting("steps of Gilbert's algorithm", ge=1, le=10000)
    weight: float = setting("of a newton of imbalance", ge=0, le=100000)


class ShapeSettings(Settings):
    """How hands keep to the shape of their grip."""

    reach_m: float = setting("gap at which a link no longer pushes", gt=0, le=0.1)
    closing_weight: float = setting(
        "length of the closing direction added to the unit normal", ge=0, le=100
    )
    weight: float = setting("of a measure that lacks all of its least", ge=0, le=100000)
    kept: float = setting("deviation up to which a held hand has kept its grip", ge=0, le=3)


class RefinementSettings(Settings):
    """Random steps around the best candidates."""

    parents: int = setting("candidates that are refined", ge=1, le=1000)
    rounds: int = setting("how often each is varied", ge=0, le=100)
    children: int = setting("variations of each in a round", ge=1, le=1000)
    position_sd_m: float = setting("deviation of the first round", ge=0, le=0.1)
    rotation_sd_rad: float = setting("deviation of the first round", ge=0, le=1.6)
    spread_sd_rad: float = setting("deviation of the first round", ge=0, le=1.6)
    shrink: float = setting("factor of the deviations from round to round", gt=0, le=1)


class RankingSettings(Settings):
    """Which grasps are tried."""

    tries: int = setting("grasps a session that are tried at most", ge=1, le=100)
    min_fingers: int = setting("fingers that must touch", ge=1, le=3)
    contact_m: float = setting("gap up to which a link touches", gt=0, le=0.01)
    max_depth_m: float = setting("depth beyond which a candidate is not ranked", ge=0, le=0.05)
    apart_m: float = setting("least difference between tries", ge=0, le=0.2)
    rotation_length_m: float = setting("what a radian counts in that difference", ge=0, le=1)


class SynthesisSettings(Settings):
    """Grasps of the hand, one a session."""

    hand: HandSampling
    candidates: CandidateSettings
    closing: ClosingSettings
    energy: EnergySettings
    equilibrium: EquilibriumSettings
    grip_shape: ShapeSettings
    refinement: RefinementSettings
    ranking: RankingSettings
