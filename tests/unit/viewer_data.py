"""A small dataset beside its files, as a checkout has it: real parts, few grasps."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import trimesh
from tests.unit.settings import PARAMS

from grasptypes.contact_maps.contact_map import BY_SESSION, ContactMap
from grasptypes.contact_maps.contact_map_files import write_contact_map
from grasptypes.hands.reading import load_hand
from grasptypes.labels.dataset import joint_columns
from grasptypes.objects.mesh_import import import_model
from grasptypes.objects.object_files import read_surface
from grasptypes.objects.preparation import prepare
from grasptypes.settings.objects import OwnObject

HAND = load_hand("barrett")
TASKS = ("use", "handoff")
TYPES = ("Power Sphere", "Precision", "Invalid")


def write_dataset(data: Path) -> Path:
    """Two objects, two tasks, three grasps each, the last one dropped; returns the table."""
    for name, size in (("can", (0.03, 0.1)), ("jar", (0.04, 0.08))):
        _write_object(data, name, size)
    rows = [
        _row(name, task, session, place)
        for place, (name, task, session) in enumerate(
            (name, task, session)
            for name in ("can", "jar")
            for task in TASKS
            for session in (1, 2, 3)
        )
    ]
    pd.DataFrame(rows).to_csv(data / "grasps.csv", index=False)
    return data / "grasps.csv"


def _write_object(data: Path, name: str, size: tuple[float, float]) -> None:
    mesh = data / f"{name}.stl"
    data.mkdir(parents=True, exist_ok=True)
    trimesh.creation.cylinder(*size, sections=32).export(mesh)
    own = OwnObject.check({"file": str(mesh), "unit": "m", "density_kg_m3": 500.0})
    imported = import_model(own, PARAMS.objects.import_)
    prepare(name, imported, PARAMS.objects.resolution, data / "objects" / name)
    properties = data / "objects" / name / "properties.json"
    roles = {"roles": {"body": {"role": "container_wall", "attributes": []}}}
    properties.write_text(json.dumps(json.loads(properties.read_text()) | roles))
    surface = read_surface(data / "objects" / name / "surface.npz")
    whole = trimesh.Trimesh(surface.vertices, surface.faces, process=False)
    count = len(surface.vertices)
    for task in TASKS:
        values = np.linspace(0, 1, count) if task == "use" else np.zeros(count)
        per_session = {key: np.zeros((1, 3)) for key in BY_SESSION}
        per_session |= {key: np.array(["x"]) for key in ("style", "grip", "part")}
        per_session |= {key: np.zeros(1) for key in ("height", "hand_length_m")}
        contact_map = ContactMap(
            points=surface.vertices.astype(np.float32),
            normals=np.array(whole.vertex_normals, dtype=np.float32),
            part_index=surface.part_index,
            part_names=surface.part_names,
            probability=values.astype(np.float32),
            sessions=np.zeros((1, count), dtype=np.float32),
            **per_session,
        )
        write_contact_map(contact_map, data / "contact_maps" / name / f"{task}.npz")
        held = pd.DataFrame(
            {
                "session": [1, 2, 3],
                "contact_links": [["distal_1", "palm"], ["distal_2"], []],
                "contact_points_m": [[0.03, 0, 0, 0, 0.03, 0], [0.03, 0, 0], []],
                "contact_normals": [[-1.0, 0, 0, 0, -1, 0], [-1.0, 0, 0], []],
                "contact_forces_n": [[12.0, 3.0], [5.0], []],
            }
        )
        (data / "grasps" / name).mkdir(parents=True, exist_ok=True)
        held.to_parquet(data / "grasps" / name / f"{task}.parquet")


def _row(name: str, task: str, session: int, place: int) -> dict[str, object]:
    away_m = 0.02 + 0.02 * session
    dofs = [0.1 * session, 1.2, 1.1, 1.0 + 0.1 * session]
    pose = [0, 1, 0, 0, 0, 0, -1, away_m, -1, 0, 0, 0]
    grasp_type = TYPES[session - 1]
    joints = dict(zip(joint_columns(HAND), HAND.couple(dofs).tolist(), strict=True))
    return {
        "Index": place,
        "Object": name,
        "Intent": task,
        "Session": session,
        "GraspType": grasp_type,
        "GraspTypeIndex": [4, 6, 7][session - 1],
        "Rank": 1,
        "Error": 0.5 - 0.1 * session,
        "HandConfiguration": ",".join(map(str, [0, *pose, *dofs])),
        "reason": "dropped" if grasp_type == "Invalid" else "valid",
        "shape": grasp_type,
        "branch": "power: palm gap 1.0 mm <= 18.9 mm",
        "margin": 0.5,
        "penetration_m": 0.0001,
        "tries": 1,
        **joints,
    }
