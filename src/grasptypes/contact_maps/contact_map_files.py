"""Contact maps on disk: one array per field, checked when read."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import numpy as np

from grasptypes.contact_maps.contact_map import BY_SESSION, ContactMap
from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz

# Fields with one row per surface point.
BY_POINT = ("normals", "part_index", "probability")


def write_contact_map(contact_map: ContactMap, path: str | Path) -> None:
    """Write an .npz with one array per field."""
    write_npz(path, {field.name: getattr(contact_map, field.name) for field in fields(ContactMap)})


def read_contact_map(path: str | Path) -> ContactMap:
    """Read a file of :func:`write_contact_map`.

    Raises:
        InputError: an array is missing, has the wrong length, or has values that are not
            probabilities.
    """
    arrays = read_npz(path)
    for field in fields(ContactMap):
        if field.name not in arrays:
            raise InputError(path, field.name, "is missing; rebuild the contact map")
    contact_map = ContactMap(**{field.name: arrays[field.name] for field in fields(ContactMap)})
    _check_lengths(contact_map, path)
    for name in ("probability", "sessions"):
        values = getattr(contact_map, name)
        if not ((values >= 0) & (values <= 1)).all():
            raise InputError(path, name, "has values outside the range 0 to 1")
    return contact_map


def _check_lengths(contact_map: ContactMap, path: str | Path) -> None:
    points, sessions = len(contact_map.points), len(contact_map.style)
    if contact_map.sessions.shape != (sessions, points):
        shape = contact_map.sessions.shape
        message = f"has shape {shape} for {sessions} sessions and {points} points"
        raise InputError(path, "sessions", message)
    expected = dict.fromkeys(BY_SESSION, sessions) | dict.fromkeys(BY_POINT, points)
    for name, length in expected.items():
        if np.shape(getattr(contact_map, name))[:1] != (length,):
            raise InputError(path, name, f"must have {length} entries")
