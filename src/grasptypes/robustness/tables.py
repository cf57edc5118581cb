"""Tables of the tests: one row per grasp, and the summary by object."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.physics.engines import ENGINES
from grasptypes.physics.holding import DIRECTIONS

ALL = "all"
SIX = len(DIRECTIONS)
MM = 1e3
_SHARE = pa.Check.in_range(0, 1)


def _of_engine(name: str) -> dict[str, pa.Column]:
    """Columns of one engine."""
    count = pa.Check.in_range(0, SIX)
    return {
        f"plays_back_{name}": pa.Column(
            bool, description="the dataset's own test holds when it is repeated from the file"
        ),
        f"holds_again_{name}": pa.Column(bool, description="the same, from the held state"),
        f"directions_{name}": pa.Column(
            int, count, description="directions of gravity in which the object is not lost"
        ),
        f"strict_directions_{name}": pa.Column(int, count, description="by the stricter rule"),
        f"creep_m_s_{name}": pa.Column(
            float, pa.Check.ge(0), description="median speed where held; infinite if nowhere"
        ),
        f"bears_load_{name}": pa.Column(bool, description="the task's load and gravity"),
    }


ROBUSTNESS_SCHEMA = pa.DataFrameSchema(
    {
        "Object": pa.Column(str),
        "Intent": pa.Column(str),
        "Session": pa.Column(int, pa.Check.ge(1)),
        "valid": pa.Column(bool, description="as the dataset says"),
        **{key: column for name in ENGINES for key, column in _of_engine(name).items()},
        "robustness": pa.Column(float, _SHARE, description="share of the draws that hold"),
        "epsilon_n": pa.Column(float, pa.Check.ge(0), description="see physics.wrench_space"),
        "volume_n6": pa.Column(float, pa.Check.ge(0)),
    },
    strict=True,
    ordered=True,
    unique=["Object", "Intent", "Session"],
)
SUMMARY_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str, unique=True),
        "grasps": pa.Column(int, pa.Check.ge(1)),
        "valid": pa.Column(int, pa.Check.ge(0)),
        **{
            f"{key}_{name}": pa.Column(float, _SHARE, nullable=True)
            for key in ("plays_back", "holds_again", "six", "six_strict", "bears_load")
            for name in ENGINES
        },
        "six_both": pa.Column(float, _SHARE, nullable=True),
        **{f"creep_mm_s_{name}": pa.Column(float, nullable=True) for name in ENGINES},
        "robustness": pa.Column(float, _SHARE, nullable=True),
        "epsilon_n": pa.Column(float, pa.Check.ge(0), nullable=True),
    },
    strict=True,
    ordered=True,
)
CONFUSION_SCHEMA = pa.DataFrameSchema(
    {
        f"six_{ENGINES[0]}": pa.Column(bool),
        **{f"six_{name}": pa.Column(bool) for name in ENGINES[1:]},
        "grasps": pa.Column(int, pa.Check.ge(0)),
    },
    strict=True,
    ordered=True,
)
CORRELATION_SCHEMA = pa.DataFrameSchema(
    {
        "measure": pa.Column(str, unique=True),
        "rank_correlation": pa.Column(float, pa.Check.in_range(-1, 1), nullable=True),
        "grasps": pa.Column(int, pa.Check.ge(0)),
    },
    strict=True,
    ordered=True,
)


def holds_six(tests: pd.DataFrame, name: str) -> pd.Series:
    """Whether each grasp holds in all directions in an engine."""
    return tests[f"directions_{name}"] == SIX


def summary(tests: pd.DataFrame) -> pd.DataFrame:
    """Shares and medians of the valid grasps, by object and of all: `SUMMARY_SCHEMA`."""
    groups: list[tuple[str, pd.DataFrame]] = [
        (str(name), rows) for name, rows in tests.groupby("Object", sort=True)
    ]
    return pd.DataFrame([_summary_row(name, rows) for name, rows in [*groups, (ALL, tests)]])


def _summary_row(name: str, tests: pd.DataFrame) -> dict[str, str | int | float]:
    valid = tests[tests.valid]
    six = {engine: holds_six(valid, engine) for engine in ENGINES}
    strict = {engine: valid[f"strict_directions_{engine}"] == SIX for engine in ENGINES}
    shares = {
        "plays_back": {engine: valid[f"plays_back_{engine}"] for engine in ENGINES},
        "holds_again": {engine: valid[f"holds_again_{engine}"] for engine in ENGINES},
        "six": six,
        "six_strict": strict,
        "bears_load": {engine: valid[f"bears_load_{engine}"] for engine in ENGINES},
    }
    creep = {engine: valid[f"creep_m_s_{engine}"] for engine in ENGINES}
    both = np.logical_and.reduce([held.to_numpy() for held in six.values()])
    return {
        "object": name,
        "grasps": len(tests),
        "valid": len(valid),
        **{
            f"{key}_{engine}": round(float(held.mean()), 3)
            for key, by_engine in shares.items()
            for engine, held in by_engine.items()
        },
        "six_both": round(float(both.mean()), 3) if len(both) else np.nan,
        **{f"creep_mm_s_{key}": round(_finite_median(v) * MM, 4) for key, v in creep.items()},
        "robustness": round(float(valid.robustness.median()), 3),
        "epsilon_n": round(float(valid.epsilon_n.median()), 3),
    }


def _finite_median(values: pd.Series) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.median())


def confusion(tests: pd.DataFrame) -> pd.DataFrame:
    """How often the engines agree on all directions of valid grasps: `CONFUSION_SCHEMA`."""
    valid = tests[tests.valid]
    first, second = (holds_six(valid, name) for name in ENGINES)
    return pd.DataFrame(
        [
            {
                f"six_{ENGINES[0]}": one,
                f"six_{ENGINES[1]}": other,
                "grasps": int(((first == one) & (second == other)).sum()),
            }
            for one in (True, False)
            for other in (True, False)
        ]
    )


def correlations(
    tests: pd.DataFrame, measures: Sequence[str] = ("epsilon_n", "volume_n6")
) -> pd.DataFrame:
    """Spearman's correlation of quality measures with robustness, of valid grasps."""
    valid = tests[tests.valid]
    return pd.DataFrame(
        [
            {
                "measure": name,
                "rank_correlation": round(
                    float(valid[name].corr(valid.robustness, method="spearman")), 3
                ),
                "grasps": len(valid),
            }
            for name in measures
        ]
    )
