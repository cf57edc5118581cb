"""From the sections of params.yaml to what the modules take."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grasptypes.synthesis.candidates import CandidateSettings
from grasptypes.synthesis.closing import ClosingSettings
from grasptypes.synthesis.energy import EnergySettings
from grasptypes.synthesis.equilibrium import EquilibriumSettings
from grasptypes.synthesis.grip_shape import ShapeRanges, ShapeSettings
from grasptypes.synthesis.hand_model import hand_model
from grasptypes.synthesis.search import RankingSettings, RefinementSettings, SearchSettings
from grasptypes.synthesis.trials import Hand


def search_settings(synthesis: Mapping[str, Any]) -> SearchSettings:
    """The `synthesis` section of params.yaml, whose keys are the settings' fields."""
    grips = synthesis["candidates"]["grips"]
    return SearchSettings(
        candidates=CandidateSettings(**synthesis["candidates"]),
        closing=ClosingSettings(**synthesis["closing"]),
        energy=EnergySettings(**synthesis["energy"]),
        equilibrium=EquilibriumSettings(**synthesis["equilibrium"]),
        grip_shape=ShapeSettings(**synthesis["grip_shape"]),
        shapes={grip: ShapeRanges(**how["shape"]) for grip, how in grips.items()},
        refinement=RefinementSettings(**synthesis["refinement"]),
        ranking=RankingSettings(**synthesis["ranking"]),
    )


def sampled_hand(synthesis: Mapping[str, Any]) -> Hand:
    """The hand at the resolutions of the `synthesis` section."""
    sampling, reach_m = synthesis["hand"], synthesis["energy"]["range_m"]
    grid_m, check_m = sampling["grid_spacing_m"], sampling["check_spacing_m"]
    return Hand(
        hand_model(sampling["finger_spacing_m"], sampling["base_spacing_m"], grid_m, reach_m),
        hand_model(check_m, check_m, grid_m, reach_m),
    )
