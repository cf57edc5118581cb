"""All hands beside each other: reports/hands.csv, hand_tables.csv and hand_models.csv.

``python -m benchmarks.hands`` counts the grasps of this checkout and of those that `make hand` made
in hands/, joins their Tables I, compares the forward kinematics of every hand that comes with the
package with those of physics engines, and measures the time that it takes to find grasps with it,
beside the hand of params.yaml. ``python -m benchmarks.hands grasps`` only counts and joins.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pandera.pandas as pa
from benchmarks.figures import seconds
from benchmarks.hand_kinematics import kinematics_errors
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.hands.folders import hand_names
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.objects.object_geometry import read_object
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import HoldResult, hold
from grasptypes.physics.loads import task_load
from grasptypes.settings.params import Params, read_params
from grasptypes.settings.tasks import read_tasks
from grasptypes.synthesis.grasps import GRASP_SCHEMA, REASONS
from grasptypes.synthesis.hand_model import sample_hand
from grasptypes.synthesis.scene import grasp_scene
from grasptypes.synthesis.tester import GraspTester
from grasptypes.synthesis.trials import SynthesisTask, synthesize_sessions
from grasptypes.tables import read_table, write_table
from grasptypes.yaml_files import read_yaml

Array = NDArray[np.float64]

SETTINGS = Path(__file__).with_name("settings.yaml")
GRASPS, TABLES = Path("reports/hands.csv"), Path("reports/hand_tables.csv")
MODELS = Path("reports/hand_models.csv")

GRASP_COUNTS = pa.DataFrameSchema(
    {
        "hand": pa.Column(str),
        "object": pa.Column(str),
        "task": pa.Column(str),
        "grasps": pa.Column(int, pa.Check.gt(0), description="one per session"),
        "valid": pa.Column(int, pa.Check.ge(0)),
        **{reason: pa.Column(int, pa.Check.ge(0)) for reason in REASONS},
    },
    strict=True,
    ordered=True,
    unique=["hand", "object", "task"],
)
MEASURES = ("sim_mean", "sim_sd", "acc_mean", "acc_sd", "prec_mean", "prec_sd", "freq_mean")
TABLE_SCHEMA = pa.DataFrameSchema(
    {
        "hand": pa.Column(str),
        "model": pa.Column(str),
        **{measure: pa.Column(float, nullable=True) for measure in MEASURES},
    },
    strict=True,
    ordered=True,
    unique=["hand", "model"],
)
MODEL_SCHEMA = pa.DataFrameSchema(
    {
        "hand": pa.Column(str),
        "fingers": pa.Column(int),
        "joints": pa.Column(int),
        "pybullet_mm": pa.Column(
            float, description="largest distance of a joint or fingertip from where PyBullet has it"
        ),
        "mujoco_mm": pa.Column(float, description="the same, MuJoCo"),
        "session_s": pa.Column(float, description="processor time of a session, median"),
        "ratio": pa.Column(float, description="to the hand of params.yaml, median over the rounds"),
        "tests": pa.Column(float, description="physics tests of a session"),
        "test_s": pa.Column(float, description="processor time of such a test, mean"),
    },
    strict=True,
    ordered=True,
    unique=["hand"],
)


def checkouts(hand: str) -> dict[str, Path]:
    """Folders by hand: this checkout, whose hand is given, and those below hands/."""
    others = sorted(path.parent for path in Path("hands").glob("*/data"))
    return {hand: Path()} | {folder.name: folder for folder in others}


def count_grasps(folders: Mapping[str, Path]) -> pd.DataFrame:
    """Table of `GRASP_COUNTS`: what became of the sessions of each object and task."""
    rows = [
        {"hand": hand, "object": path.parent.name, "task": path.stem}
        | outcomes(read_table(path, GRASP_SCHEMA))
        for hand, folder in folders.items()
        for path in sorted(folder.glob("data/grasps/*/*.parquet"))
    ]
    return pd.DataFrame(rows, columns=list(GRASP_COUNTS.columns))


def join_tables(folders: Mapping[str, Path]) -> pd.DataFrame:
    """Table of `TABLE_SCHEMA`: Table I of each hand that has one, on simulated labels."""
    tables = [
        pd.read_csv(folder / "reports/table1.csv").assign(hand=hand)
        for hand, folder in folders.items()
        if (folder / "reports/table1.csv").exists()
    ]
    columns = list(TABLE_SCHEMA.columns)
    return pd.concat(tables)[columns] if tables else pd.DataFrame(columns=columns)


def outcomes(grasps: pd.DataFrame) -> dict[str, int]:
    """Numbers of grasps: all, the valid ones, and those that fail for each reason."""
    reasons = {reason: int((grasps.reason == reason).sum()) for reason in REASONS}
    return {"grasps": len(grasps), "valid": int(grasps.valid.sum()), **reasons}


class Timed:
    """A function that keeps how often it was called, and the processor time that this took."""

    def __init__(self, function: Callable[..., HoldResult]) -> None:
        self.function, self.calls, self.seconds = function, 0, 0.0

    def __call__(self, *values: Array) -> HoldResult:
        """The function's result."""
        begun = time.process_time()
        result = self.function(*values)
        self.seconds += time.process_time() - begun
        self.calls += 1
        return result


def measure_times(
    hands: Mapping[str, Hand], settings: Mapping[str, Any], params: Params
) -> dict[str, dict[str, float]]:
    """Time of sessions by hand, which take turns; ratios to the first hand."""
    name, task = settings["object"], settings["task"]
    geometry = read_object(Path("data/objects") / name)
    contact_map = read_contact_map(f"data/contact_maps/{name}/{task}.npz")
    some = replace(contact_map, sessions=contact_map.sessions[: settings["sessions"]])
    test, load = params.physics, None
    load = task_load(read_tasks()[task], geometry, test.test.gravity_m_s2)
    sessions = SynthesisTask(name, task, geometry, some, params.seed, load)
    surface_m = contact_map.points.astype(np.float64)
    with ExitStack() as stack:
        works, tests = [], []
        for hand in hands.values():
            models = sample_hand(hand, params.synthesis)
            scene = grasp_scene(hand, models.search, geometry, surface_m)
            worlds = [
                stack.enter_context(engine(kind, hand, geometry, test.test))
                for kind in test.test.engines
            ]
            first, *others = worlds
            timed = [
                Timed(partial(hold, first, load=load)),
                *(Timed(partial(hold, other)) for other in others),
            ]
            tester = GraspTester(
                scene._replace(model=models.check), timed[0], test.validity, timed[1:]
            )
            works.append(partial(synthesize_sessions, sessions, scene, tester, params.synthesis))
            tests.append(timed)
        taken_s = seconds(*works, rounds=settings["rounds"], clock=time.process_time)
    session_s = np.median(taken_s, axis=0) / settings["sessions"]
    ratios = np.median(taken_s / taken_s[:, :1], axis=0)
    turns = (settings["rounds"] + 1) * settings["sessions"]
    return {
        hand: {
            "session_s": float(one),
            "ratio": float(ratio),
            "tests": timed[0].calls / turns,
            "test_s": sum(each.seconds for each in timed) / timed[0].calls,
        }
        for hand, one, ratio, timed in zip(hands, session_s, ratios, tests, strict=True)
    }


def model_rows(settings: Mapping[str, Any], params: Params) -> Iterator[dict[str, object]]:
    """A row of `MODEL_SCHEMA` per hand, that of the parameters first."""
    names = sorted({params.hand, *hand_names()}, key=lambda name: (name != params.hand, name))
    hands = {name: load_hand(name) for name in names}
    times = measure_times(hands, settings, params)
    for name, hand in hands.items():
        bullet_m, mujoco_m = kinematics_errors(hand, settings["joint_vectors"])
        row: dict[str, object] = {"hand": name, "fingers": len(hand.fingers)}
        row |= {"joints": len(hand.joints), "pybullet_mm": float(f"{1e3 * bullet_m:.4g}")}
        measured = {"mujoco_mm": 1e3 * mujoco_m, **times[name]}
        yield row | {key: float(f"{value:.4g}") for key, value in measured.items()}


def main() -> None:
    """Command line."""
    params = read_params("params.yaml")
    folders = checkouts(params.hand)
    counts, tables = count_grasps(folders), join_tables(folders)
    write_table(counts, GRASPS, GRASP_COUNTS)
    write_table(tables, TABLES, TABLE_SCHEMA)
    total = counts.drop(columns=["object", "task"]).groupby("hand").sum()
    sys.stdout.write(f"{total.assign(share=total.valid / total.grasps).to_string()}\n")
    if sys.argv[1:] != ["grasps"]:
        rows = pd.DataFrame(model_rows(read_yaml(SETTINGS)["hands"], params))
        write_table(rows, MODELS, MODEL_SCHEMA)
        sys.stdout.write(f"{rows.to_string()}\n")


if __name__ == "__main__":
    main()
