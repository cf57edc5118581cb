"""Section `synthesis`: the search for grasps (ContactGrasp, Brahmbhatt et al. 2019, section IV)."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Many, Settings, Share, Weight, setting


class HandSampling(Settings):
    """How finely the hand is sampled."""

    finger_spacing_m: float = setting(
        "distance between points on the fingers during the search", ge=0.002, le=0.02
    )
    base_spacing_m: float = setting(
        "the same on the palm and on links that do not close", ge=0.002, le=0.03
    )
    check_spacing_m: float = setting(
        "distance between points of the final check", ge=0.002, le=0.02
    )
    grid_spacing_m: float = setting("spacing of the links' distance grids", ge=0.001, le=0.01)


class CandidateSettings(Settings):
    """How candidates are drawn."""

    number: int = setting("candidates per session", ge=1, le=100000)
    follow_share: Share = setting("share that follows the person's placement")
    position_sd_m: float = setting("standard deviation of the target point", ge=0, le=0.1)
    tilt_sd_rad: float = setting("standard deviation of approach and roll", ge=0, le=1.6)
    rolls: int = setting("evenly spaced rolls of candidates that do not follow", ge=1, le=360)
    back_offs_m: Many[Annotated[float, Field(ge=0, le=0.2)]] = setting(
        "how far hands back off after touching", min_length=1
    )


class ClosingSettings(Settings):
    """When a moving link stops."""

    touch_m: float = setting("distance between touching surfaces", gt=0, le=0.005)
    self_depth_m: float = setting(
        "depth of a finger in the palm or another finger above which its last motion is taken back",
        ge=0,
        le=0.01,
    )


class EnergySettings(Settings):
    """ContactGrasp's energy."""

    contact_threshold: Share = setting("contact above which a point attracts")
    attraction_points: int = setting("maximum number of attracting points", ge=1, le=10000)
    repulsion_points: int = setting("maximum number of repelling points", ge=0, le=10000)
    attraction_weight: Weight = setting("per metre between hand and an attracting point")
    repulsion_weight: Weight = setting("per metre between hand and a repelling point")
    thumb_weight: Weight = setting("per metre between the thumb and the nearest attracting point")
    penetration_weight: Weight = setting("per metre of penetration of the object")
    self_collision_weight: Weight = setting("per metre of penetration between links")
    range_m: float = setting("distance above which terms are constant", gt=0, le=0.02)
    repulsion_offset_m: float = setting(
        "largest distance of the nearest hand point from a repelling point's normal", ge=0, le=0.1
    )


class EquilibriumSettings(Settings):
    """Balance of the touching points."""

    friction: float = setting("Coulomb coefficient of this measure", ge=0, le=5)
    cone_edges: int = setting("edges of a friction pyramid", ge=3, le=64)
    contact_m: float = setting("gap below which points touch", gt=0, le=0.01)
    iterations: int = setting("steps of Gilbert's algorithm", ge=1, le=10000)
    weight: Weight = setting("per newton of wrench residual")


class ShapeSettings(Settings):
    """How strictly hands keep to the shape of their grip."""

    reach_m: float = setting("gap above which a link no longer pushes", gt=0, le=0.1)
    closing_weight: float = setting(
        "weight of the closing direction relative to the unit normal", ge=0, le=100
    )
    weight: Weight = setting("cost of a measure that falls short of its minimum by 100 %")
    kept: float = setting("deviation below which a held hand has kept its grip", ge=0, le=3)


class RefinementSettings(Settings):
    """Random steps around the best candidates."""

    parents: int = setting("number of candidates to refine", ge=1, le=1000)
    rounds: int = setting("number of rounds of variation", ge=0, le=100)
    children: int = setting("variations of each per round", ge=1, le=1000)
    position_sd_m: float = setting("standard deviation in the first round", ge=0, le=0.1)
    rotation_sd_rad: float = setting("standard deviation in the first round", ge=0, le=1.6)
    preshape_sd_rad: float = setting("standard deviation in the first round", ge=0, le=1.6)
    shrink: float = setting("factor on the deviations from round to round", gt=0, le=1)


class RankingSettings(Settings):
    """Which grasps are tried."""

    tries: int = setting("maximum number of grasps tried per search", ge=1, le=100)
    searches: int = setting(
        "maximum number of searches per session: a further one if no grasp is valid", ge=1, le=10
    )
    load_tries: int = setting(
        "number of further grasps tried if one is valid but does not bear the task's load", ge=0
    )
    min_fingers: int = setting("number of fingers that must touch", ge=1, le=5)
    contact_m: float = setting("gap below which a link touches", gt=0, le=0.01)
    max_depth_m: float = setting(
        "penetration depth above which a candidate is not ranked", ge=0, le=0.05
    )
    apart_m: float = setting("smallest difference between tries", ge=0, le=0.2)
    rotation_length_m: Share = setting("length equivalent of a radian in that difference")


class SynthesisSettings(Settings):
    """Grasps of the hand, one per session."""

    hand: HandSampling
    candidates: CandidateSettings
    closing: ClosingSettings
    energy: EnergySettings
    equilibrium: EquilibriumSettings
    grip_shape: ShapeSettings
    refinement: RefinementSettings
    ranking: RankingSettings
