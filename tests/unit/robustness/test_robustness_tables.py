"""The summary counts valid grasps only, and the confusion has every grasp once."""

import numpy as np
import pandas as pd

from grasptypes.physics.engines import ENGINES
from grasptypes.robustness.tables import (
    CONFUSION_SCHEMA,
    CORRELATION_SCHEMA,
    ROBUSTNESS_SCHEMA,
    SUMMARY_SCHEMA,
    confusion,
    correlations,
    summary,
)


def table_of(directions, valid):
    """Grasps with these numbers of directions in the two engines."""
    count = len(directions)
    table = pd.DataFrame(
        {
            "Object": ["cup", "mug"] * (count // 2),
            "Intent": "use",
            "Session": np.arange(1, count + 1),
            "valid": valid,
        }
    )
    for place, name in enumerate(ENGINES):
        held = np.array([pair[place] for pair in directions])
        table[f"plays_back_{name}"] = held > 0
        table[f"holds_again_{name}"] = held > 1
        table[f"directions_{name}"] = held
        table[f"strict_directions_{name}"] = np.maximum(held - 1, 0)
        table[f"creep_m_s_{name}"] = np.where(held > 0, 0.001, np.inf)
        table[f"bears_load_{name}"] = held > 2
    table["robustness"] = np.linspace(0.0, 1.0, count)
    table["epsilon_n"] = np.linspace(0.0, 2.0, count)
    table["volume_n6"] = np.linspace(1.0, 0.0, count)
    return ROBUSTNESS_SCHEMA.validate(table)


def test_shares_are_of_the_valid_grasps() -> None:
    tests = table_of([(6, 6), (6, 0), (0, 6), (6, 6)], valid=[True, True, False, True])
    found = SUMMARY_SCHEMA.validate(summary(tests)).set_index("object")
    assert found.loc["cup", "valid"] == 1
    assert found.loc["cup", "six_both"] == 1.0
    assert found.loc["mug", "six_both"] == 0.5
    assert found.loc["all", "grasps"] == 4
    assert found.loc["all", "creep_mm_s_pybullet"] == 1.0


def test_the_confusion_counts_every_valid_grasp_once() -> None:
    tests = table_of([(6, 6), (6, 0), (0, 6), (5, 5)], valid=[True, True, True, True])
    found = CONFUSION_SCHEMA.validate(confusion(tests))
    assert found.grasps.tolist() == [1, 1, 1, 1]


def test_rank_correlations() -> None:
    found = CORRELATION_SCHEMA.validate(correlations(table_of([(6, 6)] * 4, True)))
    assert found.rank_correlation.tolist() == [1.0, -1.0]
