"""The viewer as one HTML page that needs no network: data, the page's own script, and three.js."""

from __future__ import annotations

import base64
import gzip
import html
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from grasptypes.hands.hand import Hand
from grasptypes.viewer import PAGE_FILES
from grasptypes.viewer.grasp_views import GraspViews, ShownGrasp
from grasptypes.viewer.shown_object import ShownObject

HERE = Path(__file__).parent
# Steps in which a coordinate is stored: a few micrometres on an object of 0.3 m.
STEPS = 65535
# Decimals of numbers in the page: a hundredth of a millimetre, a milliradian.
METRES, RADIANS, NEWTONS = 5, 3, 2


class Blob:
    """Arrays of an object as one compressed text; each is known by its place, type and length."""

    def __init__(self) -> None:
        self._content = bytearray()

    def add(self, array: ArrayLike, kind: type[np.generic]) -> list[Any]:
        """Append an array; returns [offset, type, length]."""
        flat = np.ascontiguousarray(array, dtype=kind).ravel()
        self._content += b"\0" * (-len(self._content) % flat.itemsize)
        place = [len(self._content), flat.dtype.name, len(flat)]
        self._content += flat.tobytes()
        return place

    def text(self) -> str:
        """The arrays, gzipped and in base64."""
        return base64.b64encode(gzip.compress(bytes(self._content), 9, mtime=0)).decode()


def page(views: GraspViews) -> str:
    """The whole page."""
    blobs, objects = {}, {}
    for name, shown in views.objects.items():
        blob = Blob()
        objects[name] = _object(shown, blob)
        blobs[f"object {name}"] = blob.text()
    hand_blob = Blob()
    content = {
        "title": views.title,
        "hand": views.hand and _hand(views.hand, hand_blob),
        "objects": objects,
        "grasps": [_grasp(grasp, views.hand) for grasp in views.grasps if views.hand],
    }
    blobs["hand"] = hand_blob.text()
    stores = "\n".join(
        f'<script type="text/plain" id="{html.escape(name)}">{text}</script>'
        for name, text in blobs.items()
    )
    template, script, three = ((HERE / name).read_text(encoding="utf-8") for name in PAGE_FILES)
    values = {
        "title": html.escape(views.title),
        "content": json.dumps(content, separators=(",", ":")).replace("</", "<\\/"),
        "stores": stores,
        "three": three,
        "script": script,
    }
    return re.sub(r"{{(\w+)}}", lambda found: values[found[1]], template)


def _mesh(vertices: ArrayLike, faces: ArrayLike, blob: Blob) -> dict[str, Any]:
    """A mesh with its coordinates in steps of its bounding box."""
    points = np.asarray(vertices, dtype=np.float64)
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    steps = np.round((points - low) / np.where(extent > 0, extent, 1.0) * STEPS)
    small = len(points) <= STEPS + 1
    return {
        "low": low.tolist(),
        "extent": extent.tolist(),
        "vertices": blob.add(steps, np.uint16),
        "faces": blob.add(faces, np.uint16 if small else np.uint32),
    }


def _object(shown: ShownObject, blob: Blob) -> dict[str, Any]:
    parts = [
        {
            "name": part.name,
            "role": part.role,
            "colour": [round(value, 4) for value in part.colour],
            "metallic": round(part.metallic, 3),
            "roughness": round(part.roughness, 3),
            "mesh": _mesh(part.mesh.vertices, part.mesh.faces, blob),
        }
        for part in shown.parts
    ]
    if shown.surface is None or not shown.maps:
        return {"parts": parts, "surface": None, "maps": {}}
    maps = {task: blob.add(np.round(values * 255), np.uint8) for task, values in shown.maps.items()}
    surface = _mesh(shown.surface.vertices, shown.surface.faces, blob)
    return {"parts": parts, "surface": surface, "maps": maps}


def _hand(hand: Hand, blob: Blob) -> dict[str, Any]:
    links = [
        {
            "name": link.name,
            "visuals": [
                {"colour": list(look.rgba[:3]), "mesh": _mesh(look.vertices_m, look.faces, blob)}
                for look in link.visuals
            ],
        }
        for link in hand.links
    ]
    joints = [
        {
            "parent": joint.parent,
            "prismatic": joint.prismatic,
            "rest": joint.T_parent_rest.ravel().tolist(),
        }
        for joint in hand.joints
    ]
    return {"title": hand.title, "links": links, "joints": joints}


def _grasp(grasp: ShownGrasp, hand: Hand) -> dict[str, Any]:
    contacts = grasp.contacts
    decimals = [METRES if joint.prismatic else RADIANS for joint in hand.joints]
    return {
        "object": grasp.object,
        "task": grasp.task,
        "session": grasp.session,
        "rank": grasp.rank,
        "type": grasp.grasp_type,
        "facts": grasp.facts,
        "pose": _rounded(grasp.T_object_hand[:3], METRES),
        "retreat": _rounded(grasp.motion.retreat_m, METRES),
        "joints": [
            [round(float(value), places) for value, places in zip(state, decimals, strict=True)]
            for state in grasp.motion.positions
        ],
        "links": list(contacts.links),
        "points": _rounded(contacts.points_m, METRES),
        "forces": None if contacts.forces_n is None else _rounded(contacts.forces_n, NEWTONS),
    }


def _rounded(values: NDArray[np.float64], decimals: int) -> list[Any]:
    return list(np.round(np.asarray(values), decimals).tolist())
