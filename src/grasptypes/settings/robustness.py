"""Section `robustness`: what recorded grasps are tested with, in both engines."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Pair, Settings, setting
from grasptypes.settings.physics import EngineName


class LossSettings(Settings):
    """From when on an object counts as lost."""

    distance_m: float = setting("movement in the hand", gt=0, le=1)
    rotation_rad: float = setting("rotation in the hand", gt=0, le=3.15)


class PerturbationSettings(Settings):
    """Draws of what may differ on a robot; the share that still holds is the robustness."""

    engine: EngineName = setting("engine that they are tested in")
    draws: int = setting("number of draws for each grasp", ge=1, le=1000)
    friction: Pair[Annotated[float, Field(ge=0, le=5)]] = setting("range of the friction")
    mass_share: Pair[Annotated[float, Field(gt=0, le=10)]] = setting(
        "range of the mass, as a share of the object's"
    )
    position_m: float = setting("how far the hand is off before it closes", ge=0, le=0.1)
    rotation_rad: float = setting("how far it is turned", ge=0, le=1.6)
    hold_time_s: float = setting("holding against gravity", ge=0.1, le=60)


class RobustnessSettings(Settings):
    """Tests of recorded grasps."""

    hold_time_s: float = setting("holding in each direction", ge=0.1, le=60)
    loss: LossSettings
    strict_loss: LossSettings
    perturbations: PerturbationSettings
    cone_edges: int = setting("edges of a friction pyramid of the wrench space", ge=3, le=64)
    loads: str = setting("table of the tasks' loads", min_length=1)
