"""Mistakes in the authors' table."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pandas as pd
from case import Case, library, script

from grasptypes.hands.reading import load_hand
from grasptypes.labels.label_sources import PUBLISHED, fetch_published

POSE = "0,1,0,0,0.1,0,1,0,0.2,0,0,1,0.3,0.5,1.0,1.1,1.2"
ROW = {
    "Index": "0", "Object": "mug", "Intent": "use", "Session": "1", "GraspType": "Precision",
    "GraspTypeIndex": "6", "Rank": "1", "Error": "-0.2", "PoseIndex": "17",
    "HandConfiguration": POSE, "Image": "",
}  # fmt: skip


def csv(*changes: dict[str, str], drop: str = "", separator: str = ",") -> str:
    """The authors' table with a row per change."""
    rows = [ROW | {"Session": str(number)} | change for number, change in enumerate(changes, 1)]
    table = pd.DataFrame(rows).drop(columns=[drop] if drop else [])
    return table.to_csv(index=False, sep=separator)


def published(what: str, content: str | bytes, *names: str) -> Case:
    """A table that GRASPTYPES_PUBLISHED_CSV names."""
    arguments = "grasps.csv", load_hand("barrett"), [Path("mug.stl")], None, Path("replay.csv")
    replay = script("replay_grasps", "replay_grasps", *arguments)
    return Case("published CSV", what, {"grasps.csv": content}, replay, ("grasps.csv", *names))


def cell(what: str, column: str, content: str, *names: str) -> Case:
    """One wrong cell in the second row."""
    return published(what, csv({}, {column: content}), f"line 3, {column}", *names)


def fetched(what: str, address: str, *names: str) -> Case:
    """A table that GRASPTYPES_PUBLISHED_CSV names by URL."""
    call = library(fetch_published, {PUBLISHED: address}, "published/grasps.csv", 0.5)
    return Case("published CSV", what, {}, call, (PUBLISHED, *names))


SHA256 = hashlib.sha256(b"").hexdigest()
CASES = [
    published("empty", "", "not a CSV table"),
    published("a header only", csv({}).splitlines()[0], "has a header but no grasps"),
    published("UTF-16", csv({}).encode("utf-16"), "not UTF-8"),
    published("semicolons between the cells", csv({}, separator=";"), "Index", "missing"),
    published("a missing column", csv({}, drop="Rank"), "Rank", "missing"),
    published(
        "a missing column after a byte order mark", csv({}, drop="Rank").encode("utf-8-sig"), "Rank"
    ),
    published("a duplicate column", csv({}).replace("Image", "Rank"), "Rank", "twice"),
    published("a duplicate row", csv({}, {"Session": "1"}), "line 3", "twice"),
    published("truncated within a row", csv({}, {})[:-10], "not a CSV table"),
    published("a row that is too short", csv({}) + "1,mug\n", "line 3, Intent"),
    cell("an unknown grasp type", "GraspType", "Hug", "'Hug'", "Large Wrap"),
    cell("an unknown task", "Intent", "throw", "handoff, use"),
    cell("16 numbers", "HandConfiguration", POSE.rsplit(",", 1)[0], "16 numbers instead of 17"),
    cell("NaN in a pose", "HandConfiguration", POSE.replace("0.3", "nan"), "finite"),
    cell(
        "a pose without a valid rotation",
        "HandConfiguration",
        "0,2" + POSE[3:],
        "no valid rotation",
    ),
    cell("millimetres", "HandConfiguration", POSE.replace("0.3", "300"), "metres"),
    cell("degrees", "HandConfiguration", POSE.replace("1.2", "120"), "radians"),
    cell("NaN", "Error", "nan", "finite"),
    cell("session 0", "Session", "0", "positive integer"),
    cell("half a session", "Session", "1.5", "not an integer"),
    fetched(
        "an unreachable host", f"http://127.0.0.1:9/t.csv#sha256={SHA256}", "127.0.0.1:9", "path"
    ),
]
