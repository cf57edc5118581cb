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


class FilmSettings(Settings):
    """Animations of a grasp, and the sheet of the worst ones."""

    engine: EngineName = setting("engine that is shown")
    frame_s: float = setting("time between two images", gt=0, le=1)
    slower: float = setting("how many times slower than real they are shown", gt=0, le=100)
    pause_s: float = setting("how long the last image stays", ge=0, le=10)
    direction_s: float = setting("how long gravity acts in each direction", gt=0, le=10)
    lost_m: float = setting("distance of the object at which the film ends", gt=0, le=1)
    worst: int = setting("number of grasps on the sheet", ge=1, le=100)
    worst_columns: int = setting("images in a row of it", ge=1, le=20)


class RobustnessSettings(Settings):
    """Tests of recorded grasps."""

    sessions: int = setting("number of sessions of each object and task that are tested", ge=1)
    hold_time_s: float = setting("holding in each direction", ge=0.1, le=60)
    loss: LossSettings
    strict_loss: LossSettings
    perturbations: PerturbationSettings
    cone_edges: int = setting("edges of a friction pyramid of the wrench space", ge=3, le=64)
    film: FilmSettings
