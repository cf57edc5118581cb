"""All hands beside each other: reports/hands.csv and reports/hand_models.csv.

``python -m benchmarks.hands`` counts the grasps of this checkout and of those that `make hand` made
in hands/, compares the forward kinematics of every hand that comes with the package with what
physics engines make of its hand.urdf, and measures the time that it takes to find grasps with it,
beside the hand of params.yaml. ``python -m benchmarks.hands grasps`` only counts.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import mujoco
import numpy as np
import pandas as pd
import pandera.pandas as pa
import pybullet
from benchmarks.figures import seconds
from numpy.typing import NDArray
from trimesh.transformations import euler_matrix

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.hands.description import HandDescription
from grasptypes.hands.folders import DESCRIPTION, URDF, hand_names
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.objects.object_geometry import read_object
from grasptypes.physics.engines import engine
from grasptypes.physics.holding import HoldResult, hold_in_all
from grasptypes.physics.loads import task_load
from grasptypes.poses import inverse
from grasptypes.seeds import rng
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
GRASPS, MODELS = Path("reports/hands.csv"), Path("reports/hand_models.csv")

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


def grasp_folders(hand: str) -> dict[str, Path]:
    """Folders of grasps by hand: of this checkout, whose hand is given, and below hands/."""
    found = {hand: Path("data/grasps")}
    for folder in sorted(Path("hands").glob("*/data/grasps")):
        found[folder.parts[1]] = folder
    return found


def count_grasps(folders: Mapping[str, Path]) -> pd.DataFrame:
    """Table of `GRASP_COUNTS`: what became of the sessions of each object and task."""
    rows = [
        {"hand": hand, "object": path.parent.name, "task": path.stem}
        | outcomes(read_table(path, GRASP_SCHEMA))
        for hand, folder in folders.items()
        for path in sorted(folder.glob("*/*.parquet"))
    ]
    return pd.DataFrame(rows, columns=list(GRASP_COUNTS.columns))


def outcomes(grasps: pd.DataFrame) -> dict[str, int]:
    """Numbers of grasps: all, the valid ones, and those that fail for each reason."""
    reasons = {reason: int((grasps.reason == reason).sum()) for reason in REASONS}
    return {"grasps": len(grasps), "valid": int(grasps.valid.sum()), **reasons}


class Marks(NamedTuple):
    """Points of a hand that its own URDF names: origins of links, and ends of fingers."""

    links: tuple[str, ...]
    tips_m: Array
    """(F, 3) in the frames of `tip_links` of the URDF."""
    tip_links: tuple[int, ...]
    """Indices in `links`."""
    T_palm_hand: Array

    def of(self, T_palm_link: Array) -> Array:
        """(n, L + F, 3) in the hand's frame, of link poses (n, L, 4, 4)."""
        T = inverse(self.T_palm_hand) @ T_palm_link
        tips = T[:, list(self.tip_links)]
        ends = np.einsum("nfij,fj->nfi", tips[..., :3, :3], self.tips_m) + tips[..., :3, 3]
        return np.concatenate([T[..., :3, 3], ends], axis=1)


def kinematics_errors(hand: Hand, number: int) -> tuple[float, float]:
    """Largest distance in metres of a joint or fingertip from where PyBullet and MuJoCo have it.

    The engines load the hand's own hand.urdf, not the one written for physics tests.

    Args:
        number: of random joint vectors within the limits.
    """
    path = Path(hand.folder) / DESCRIPTION
    described = HandDescription.check(read_yaml(path), path)
    palm, fingers = described.palm, described.fingers
    T_palm_hand = np.asarray(euler_matrix(*palm.rpy_rad, "sxyz"))
    T_palm_hand[:3, 3] = palm.xyz_m
    tips = np.array([fingers[finger.name].tip_m for finger in hand.fingers])
    links = tuple(link - 1 for link in hand.tip_links)
    marks = Marks(hand.link_names[1:], tips, links, T_palm_hand)
    low, high = hand.joint_limits.T
    draw = rng("benchmark", "kinematics", path.parent.name)
    positions = draw.uniform(low, high, (number, len(hand.joints)))
    origins = hand.link_poses(positions)[:, 1:, :3, 3]
    own = np.concatenate([origins, hand.fingertips(positions)], axis=1)
    urdf = Path(hand.folder) / URDF
    bullet, other = (
        float(np.linalg.norm(marks.of(poses(urdf, hand, positions)) - own, axis=-1).max())
        for poses in (_bullet_poses, _mujoco_poses)
    )
    return bullet, other


def _bullet_poses(urdf: Path, hand: Hand, positions: Array) -> Array:
    """T_palm_link (n, L - 1, 4, 4) of the URDF's links."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(urdf), useFixedBase=True, physicsClientId=client)
        count = pybullet.getNumJoints(body, physicsClientId=client)
        infos = [pybullet.getJointInfo(body, j, physicsClientId=client) for j in range(count)]
        joints = {info[1].decode(): info[0] for info in infos}
        links = {info[12].decode(): info[0] for info in infos}
        found = np.empty((len(positions), len(hand.link_names), 4, 4))
        for row, sample in enumerate(positions):
            for name, position in zip(hand.joint_names, sample.tolist(), strict=True):
                pybullet.resetJointState(body, joints[name], position, physicsClientId=client)
            for column, name in enumerate(hand.link_names):
                found[row, column] = _bullet_pose(client, body, links.get(name))
    finally:
        pybullet.disconnect(client)
    return inverse(found[:, :1]) @ found[:, 1:]


def _bullet_pose(client: int, body: int, link: int | None) -> Array:
    """T_root_link; the root, which has no number, is the origin."""
    T = np.eye(4)
    if link is not None:
        state = pybullet.getLinkState(
            body, link, computeForwardKinematics=True, physicsClientId=client
        )
        T[:3, :3] = np.reshape(pybullet.getMatrixFromQuaternion(state[5]), (3, 3))
        T[:3, 3] = state[4]
    return T


def _mujoco_poses(urdf: Path, hand: Hand, positions: Array) -> Array:
    """T_palm_link (n, L - 1, 4, 4) of the URDF's links."""
    spec = mujoco.MjSpec.from_file(str(urdf))
    spec.compiler.fusestatic = False
    for shape in (*spec.geoms, *spec.meshes):
        spec.delete(shape)
    model = spec.compile()
    data = mujoco.MjData(model)
    places = [model.joint(name).qposadr[0] for name in hand.joint_names]
    bodies = [model.body(name).id for name in hand.link_names]
    found = np.zeros((len(positions), len(bodies), 4, 4))
    found[..., 3, 3] = 1.0
    for T, sample in zip(found, positions, strict=True):
        data.qpos[places] = sample
        mujoco.mj_kinematics(model, data)
        T[:, :3, :3] = data.xmat[bodies].reshape(-1, 3, 3)
        T[:, :3, 3] = data.xpos[bodies]
    return inverse(found[:, :1]) @ found[:, 1:]


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
            timed = Timed(partial(hold_in_all, worlds, load=load))
            tester = GraspTester(scene._replace(model=models.check), timed, test.validity)
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
            "tests": timed.calls / turns,
            "test_s": timed.seconds / timed.calls,
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
        row |= {"joints": len(hand.joints), "pybullet_mm": 1e3 * bullet_m}
        yield row | {"mujoco_mm": 1e3 * mujoco_m, **times[name]}


def main() -> None:
    """Command line."""
    params = read_params("params.yaml")
    counts = count_grasps(grasp_folders(params.hand))
    write_table(counts, GRASPS, GRASP_COUNTS)
    total = counts.drop(columns=["object", "task"]).groupby("hand").sum()
    sys.stdout.write(f"{total.assign(share=total.valid / total.grasps).to_string()}\n")
    if sys.argv[1:] != ["grasps"]:
        rows = pd.DataFrame(model_rows(read_yaml(SETTINGS)["hands"], params))
        write_table(rows, MODELS, MODEL_SCHEMA)
        sys.stdout.write(f"{rows.to_string()}\n")


if __name__ == "__main__":
    main()
