"""Output of a plan: tables, exchange formats, and an image of the best grasps."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa
from scipy.spatial.transform import RigidTransform

from grasptypes.contact_maps.contact_map_files import write_contact_map
from grasptypes.exchange import dexgraspbench, graspit_world, multigrippergrasp
from grasptypes.exchange.published_csv import format_configuration
from grasptypes.exchange.records import PosedHands
from grasptypes.files import staging_name, write_bytes, write_json
from grasptypes.hands import configuration
from grasptypes.hands.hand import Hand
from grasptypes.labels.contact_table import contact_schema
from grasptypes.labels.dataset import VALID, dataset_columns, dataset_schema
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.object_files import COLLISION, PROPERTIES, SURFACE, VISUAL, write_surface
from grasptypes.planning.held_contacts import GRASP
from grasptypes.planning.plan_summary import summarise
from grasptypes.planning.planner import Plan
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.gallery import grasp_picture, state_of
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.segmentation.on_surface import with_parts
from grasptypes.settings.params import Params
from grasptypes.tables import write_table

PICTURE, CONTACTS, CONTACT_MAP = "grasps.png", "contacts.csv", "contact_map.npz"
ATTEMPT_TABLE_SCHEMA = pa.DataFrameSchema(
    {
        "session": pa.Column(int, pa.Check.ge(1)),
        "try": pa.Column(int, pa.Check.ge(1), description="by energy, the best first"),
        "chosen": pa.Column(bool, description="is the session's grasp"),
        "reason": pa.Column(str, description="'valid', or why the grasp is invalid"),
        "shape": pa.Column(str, pa.Check.isin(GRASP_TYPES[:-1]), description="type by the rule"),
        "branch": pa.Column(str, description="the way through the tree"),
        "margin": pa.Column(float, pa.Check.ge(0), description="to the nearest threshold"),
        "energy": pa.Column(float),
        "penetration_m": pa.Column(float, pa.Check.ge(0)),
        "moved_m": pa.Column(float, pa.Check.ge(0)),
        "turned_rad": pa.Column(float, pa.Check.ge(0)),
        "hand_configuration": pa.Column(str, description="see hands.configuration"),
    },
    strict=True,
    ordered=True,
    unique=["session", "try"],
)


def write_plan(plan: Plan, folder: Path) -> None:
    """Write a plan to a new folder, which appears completely or not at all."""
    folder = folder.resolve()
    staged = folder.with_name(staging_name(folder.name))
    staged.mkdir(parents=True)
    try:
        _write_files(plan, staged)
        os.replace(staged, folder)
    finally:
        shutil.rmtree(staged, ignore_errors=True)


def _write_files(plan: Plan, folder: Path) -> None:
    """Write tables, contact map, `plan.json`, the object, exchange formats and an image."""
    shown = plan.params.plan.shown
    valid = plan.ranking[plan.ranking.valid]
    pictured = plan.ranking.valid & (np.arange(len(plan.ranking)) < shown)
    table = plan.ranking.assign(image=np.where(pictured, PICTURE, ""))
    hand = plan.hand
    write_table(dataset_columns(table, hand), folder / "grasps.csv", dataset_schema(hand))
    write_table(_attempt_table(plan.attempts), folder / "attempts.csv", ATTEMPT_TABLE_SCHEMA)
    write_table(plan.contacts, folder / CONTACTS, contact_schema(GRASP))
    (folder / "object").mkdir()
    for name in (VISUAL, COLLISION, PROPERTIES):
        shutil.copyfile(plan.geometry.folder / name, folder / "object" / name)
    surface = plan.geometry.surface
    if plan.parts:
        surface = with_parts(surface, plan.points, plan.parts)
    write_surface(folder / "object" / SURFACE, surface)
    if plan.held_where:
        write_contact_map(plan.held_where, folder / CONTACT_MAP)
    if len(valid):
        write_formats(posed(valid, hand), folder)
        picture = draw_best(valid.head(shown), hand, plan.geometry.visual, plan.params)
        write_bytes(folder / PICTURE, picture)
    write_json(folder / "plan.json", summarise(plan))


def posed(grasps: pd.DataFrame, hand: Hand) -> PosedHands:
    """Grasps of one object for the exchange formats."""
    numbers = np.stack(grasps.hand_configuration.tolist())
    positions = np.stack(grasps.joint_angles_rad.tolist()).astype(np.float64)
    poses = RigidTransform(configuration.unpack(numbers).T_object_hand, normalize=False)
    return PosedHands(str(grasps.object.iloc[0]), hand, poses, positions, grasps.valid.to_numpy())


def write_formats(hands: PosedHands, folder: Path) -> None:
    """GraspIt! worlds, MultiGripperGrasp JSON and DexGraspBench npy, numbered by rank from 1.

    There are no worlds of a hand that GraspIt! does not know.
    """
    multigrippergrasp.write_grasps(folder / "multigrippergrasp.json", hands)
    for index in range(len(hands.held)):
        file = f"grasp_{index + 1:02}"
        body = f"models/objects/{hands.object_name}.xml"
        if hands.hand.exchange.graspit_robot is not None:
            graspit_world.write_world(folder / "graspit" / f"{file}.xml", hands, index, body)
        dexgraspbench.write_grasp(
            folder / "dexgraspbench" / f"{file}.npy", hands, index, 1.0, "object"
        )


def draw_best(grasps: pd.DataFrame, hand: Hand, visual: Path, params: Params) -> bytes:
    """PNG of the grasps, each with its rank, type and energy."""
    settings = params.gallery
    studio = plain(params.renders, settings.size_px)
    parts, tiles = load_parts(visual), []
    with Camera(studio) as camera:
        for _, row in grasps.iterrows():
            picture = grasp_picture(parts, state_of(hand, row), camera, settings.elevation_rad)
            caption = f"{row['rank'] + 1}: {row.grasp_type}, energy {row.energy:.2f}"
            tiles.append(Tile(picture, caption))
    columns = min(len(tiles), settings.columns // 2)
    picture = sheet([Group("", tiles)], columns, settings.tile_px)
    return png_bytes(picture, studio.png_compression)


def _attempt_table(attempts: pd.DataFrame) -> pd.DataFrame:
    table = pd.DataFrame(
        {
            "session": attempts.session,
            "try": attempts["rank"] + 1,
            "chosen": attempts.chosen,
            "reason": attempts.reason.where(~attempts.valid, VALID),
            **{name: attempts[name] for name in ("shape", "branch", "margin", "energy")},
            **{name: attempts[name] for name in ("penetration_m", "moved_m", "turned_rad")},
        }
    ).round(9)
    cells = [format_configuration(numbers) for numbers in attempts.hand_configuration]
    return table.assign(hand_configuration=cells)
