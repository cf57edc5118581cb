"""Mistakes in what is asked of the commands, and in the models and exchange files they read."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
from case import ROOT, Case, Content, library
from mesh_cases import STL
from picture_cases import WHOLE, command
from weights_cases import Code

from grasptypes.exchange.dexgraspbench import read_grasp
from grasptypes.exchange.graspit_world import read_world
from grasptypes.exchange.multigrippergrasp import read_grasps
from grasptypes.hands.reading import load_hand
from grasptypes.versions.checkout import copy_checkout

FOLDER = {"params.yaml": (ROOT / "params.yaml").read_bytes()}
ASK = ("predict", "cup.png", "--task", "use", "--model", "b")
MODEL = "models/simulated/task_vector"


def asked(what: str, arguments: tuple[str, ...], *names: str, **models: Content) -> Case:
    """A call of `grasptypes predict` with a good image."""
    files = FOLDER | {"cup.png": WHOLE} | {f"{MODEL}/predictor.{k}": v for k, v in models.items()}
    return Case("command", what, files, command(*arguments), names)


def exchanged(what: str, name: str, content: Content, read: Callable, *names: str) -> Case:
    """A file of another program."""
    return Case(
        "exchange file",
        what,
        {name: content},
        library(read, name, load_hand("barrett")),
        (name, *names),
    )


def cells(configuration: str) -> str:
    """A table of one grasp."""
    return f'HandConfiguration\n"{configuration}"\n'


def labelled(what: str, table: Content, *names: str, hand: str = "barrett") -> Case:
    """A call of `grasptypes label` with a good mesh."""
    words = ("label", "grasps.csv", "--object", "cup.stl", "--hand", hand)
    return Case("label", what, {"cup.stl": STL, "grasps.csv": table}, command(*words), names)


def with_code(path: Path) -> None:
    """An array file whose pickle holds code."""
    with path.open("wb") as file:
        np.lib.format.write_array_header_1_0(
            file, {"shape": (), "fortran_order": False, "descr": "|O"}
        )
        file.write(pickle.dumps(Code()))


CONFIGURATIONS = cells("0,1,0,0,0,0,1,0,0,0,0,1,0,0,1,1,1")
ONE_JOINT = CONFIGURATIONS.replace("ion\n", "ion,spread_1_rad\n").rstrip() + ",0\n"

CASES = [
    asked("no command", (), "arguments are required: COMMAND"),
    asked("an unknown command", ("guess",), "invalid choice: 'guess'"),
    asked("an unknown option", (*ASK, "--colour"), "--colour"),
    asked("an abbreviated option", (*ASK, "--pic", "answer.png"), "--pic"),
    asked("neither image nor mesh", ("predict", "--task", "use"), "are required: shown"),
    asked("an unknown unit", (*ASK, "--unit", "ell"), "--unit", "'ell'"),
    asked("a unit for an image", (*ASK, "--unit", "mm"), "--unit: mm: is for meshes"),
    asked("a missing image", ("predict", "no.png"), "no.png: no such file"),
    asked("another folder", (*ASK, "--folder", "no"), "no/params.yaml", "--folder"),
    asked("a figure that is not a PNG", (*ASK, "--picture", "cup.jpg"), "cup.jpg", ".png"),
    asked(
        "a figure that overwrites the image",
        (*ASK, "--picture", "cup.png"),
        "cup.png: is one of the",
    ),
    asked(
        "a figure among the images",
        ("predict", ".", "--task", "use", "--picture", "answer.png"),
        "answer.png: is in the folder of input images",
    ),
    Case(
        "command",
        "a folder of bad images",
        FOLDER | {"cups/a.png": "no picture", "cups/b.png": ""},
        command("predict", "cups", "--task", "use"),
        ("cups: contains no usable image", "a.png: not an image"),
    ),
    asked(
        "a figure that cannot be written",
        (*ASK, "--picture", "/proc/cup.png"),
        "/proc/cup.png: cannot be created",
    ),
    asked("a negative mass", (*ASK, "--mass-kg", "-1"), "--mass-kg: -1 kg: must be 0.001"),
    asked("an unknown model", (*ASK, "--model", "x"), "--model: x", "task_vector"),
    asked("unknown labels", (*ASK, "--labels", "../.."), "--labels: ../..", "simulated, published"),
    asked("an untrained model", ASK, f"{MODEL}/predictor.safetensors", "snakemake -j2"),
    Case(
        "command",
        "a folder without models",
        {"cup.png": WHOLE},
        command(*ASK),
        (f"{MODEL}/predictor.safetensors: there is no trained model here", "--folder"),
    ),
    asked("a damaged card", ASK, "predictor.json", "is not JSON", safetensors=b"", json="{"),
    Case(
        "command",
        "changes that are not YAML",
        {"small.yaml": "seed: [1\n"},
        library(lambda changes: copy_checkout(ROOT, "copy", changes), "small.yaml"),
        ("small.yaml", "line 2"),
    ),
    labelled("a table without grasps", "Index\n1\n", "grasps.csv: HandConfiguration: this column"),
    labelled("a short configuration", cells("0,1"), "grasps.csv: line 2, HandCon", "needs 17"),
    labelled("a word in a configuration", cells("0,one"), "line 2, HandCon", "not a number"),
    labelled(
        "a pose that is no rotation",
        cells(",".join(["0"] * 17)),
        "grasps.csv: line 2, HandConfiguration: its 3x4 pose",
    ),
    labelled("the grasps of another hand", CONFIGURATIONS, "needs 20", "--hand", hand="allegro"),
    labelled("a missing joint", ONE_JOINT, "grasps.csv: spread_2_rad: this column is missing"),
    exchanged("not XML", "world.xml", "<world>", read_world, "not a GraspIt! world"),
    exchanged("a world without a hand", "world.xml", "<world/>", read_world, "one Barrett robot"),
    exchanged("not JSON", "grasps.json", "{", read_grasps, "is not a JSON file"),
    exchanged(
        "another gripper",
        "grasps.json",
        '{"gripper": "panda", "object_id": "mug", "pose": [], "dofs": []}',
        read_grasps,
        "gripper",
    ),
    exchanged("a pickle with code", "grasp.npy", with_code, read_grasp, "not an array"),
    exchanged(
        "a bare pickle", "grasp.npy", pickle.dumps(Code()), read_grasp, "not a DexGraspBench grasp"
    ),
]
