"""What the viewer shows: grasps of a dataset, of a table, or of a plan, with their objects."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.errors import InputError, parsing
from grasptypes.hands.folders import hand_names
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.hands.states import HandStates
from grasptypes.labels.contact_table import NORMAL_COLUMNS, POINT_COLUMNS, contact_schema
from grasptypes.labels.grasp_table import number_column, read_grasp_table
from grasptypes.objects.object_files import PROPERTIES, SURFACE, VISUAL, read_surface
from grasptypes.settings.params import Params, checkout_params
from grasptypes.tables import read_table
from grasptypes.viewer.closing_motion import Motion, closing_motion
from grasptypes.viewer.shown_object import ShownObject, load_shown_object, surface_parts

Array = NDArray[np.float64]

GRASPS, PLAN, CONTACTS, CONTACT_MAP = "grasps.csv", "plan.json", "contacts.csv", "contact_map.npz"
PARTS = "parts.csv"
# Cells of a table that the viewer shows beside a grasp, if they are there.
FACTS = ("Error", "reason", "shape", "branch", "margin", "penetration_m", "tries")


class ShownContacts(NamedTuple):
    """Contacts of a grasp in the object's frame.

    Attributes:
        links: link of each.
        points_m: (n, 3).
        forces_n: (n, 3) that the hand exerts; None if nobody measured them.
    """

    links: Sequence[str]
    points_m: Array
    forces_n: Array | None


@dataclass(frozen=True)
class ShownGrasp:
    """A grasp as the viewer shows it.

    Attributes:
        rank: from 1, within its object and task by energy; a plan's own rank.
        facts: cells of its row, as text.
        T_object_hand: (4, 4) as held, metres.
        motion: how the hand got there.
    """

    object: str
    task: str
    session: int
    rank: int
    grasp_type: str
    facts: dict[str, str]
    T_object_hand: Array
    motion: Motion
    contacts: ShownContacts


@dataclass(frozen=True)
class GraspViews:
    """All that a page shows; without a hand there are no grasps."""

    title: str
    hand: Hand | None
    objects: dict[str, ShownObject]
    grasps: list[ShownGrasp] = field(default_factory=list)


def load_views(what: str, folder: Path | None, hand: str | None) -> GraspViews:
    """The views that a user asks for.

    Args:
        what: name of an object of the dataset; a CSV of grasps beside its objects; or a folder with
            one, such as a plan.
        folder: checkout with the dataset; default: the current folder.
        hand: name or folder of the hand; default: that of the plan, the release, or the parameters.

    Raises:
        InputError: there is no such thing, or its files cannot be read.
    """
    params, root = checkout_params(folder), folder or Path()
    path = Path(what)
    if path.is_dir():
        path = path / GRASPS
    elif not path.suffix:
        return _of_object(what, root, _hand(hand, params, root))
    if not path.is_file():
        raise InputError(path, "", "no such file")
    if (path.parent / PLAN).is_file():
        return _of_plan(path.parent, hand)
    if not hand and (released := sorted(path.parent.glob("hands/*/hand.yaml"))):
        hand = str(released[0].parent)
    return dataset_views(path, _hand(hand, params, root))


def _hand(name: str | None, params: Params, root: Path) -> Hand:
    return load_hand(name) if name else load_hand(params.hand, root)


def _of_object(name: str, root: Path, hand: Hand) -> GraspViews:
    """An object of a checkout's dataset."""
    table = root / "data" / GRASPS
    if not table.is_file():
        said = "no such file or folder, and there is no dataset with it: name a checkout that has "
        raise InputError(name, "", said + f"computed {table} (--folder)")
    return dataset_views(table, hand, name)


def dataset_views(path: Path, hand: Hand, only: str | None = None) -> GraspViews:
    """The views of a dataset's table beside its objects: those of a checkout, or of a release.

    Contact maps are in a checkout's folder `contact_maps`, contacts in its folder `grasps` or in a
    release's contacts.csv.

    Args:
        only: the one object to show.

    Raises:
        InputError: the table cannot be read, or an object is missing.
    """
    cells, states = read_grasp_table(path, hand)
    for column in ("Object", "Intent", "Session", "GraspType"):
        if column not in cells.columns:
            raise InputError(path, column, "this column is missing")
    if only is not None:
        chosen = (cells.Object == only).to_numpy()
        if not chosen.any():
            known = ", ".join(dict.fromkeys(cells.Object))
            raise InputError(path, "Object", f"there is no {only}; it has {known}")
        cells, states = cells[chosen], states.take(chosen)
    order = number_column(path, cells.Error) if "Error" in cells else np.arange(len(cells))
    energy = pd.Series(order, index=cells.index)
    ranks = energy.groupby([cells.Object, cells.Intent]).rank(method="first").astype(int).tolist()
    cells = cells.assign(Session=number_column(path, cells.Session).astype(int))
    tasks = list(dict.fromkeys(cells.Intent))
    objects = {
        name: _dataset_object(path.parent, name, tasks) for name in dict.fromkeys(cells.Object)
    }
    if (path.parent / CONTACTS).is_file():
        contacts = _tested(path.parent / CONTACTS, "Index", number_column(path, cells.Index))
    else:
        contacts = _recorded(path.parent, cells)
    return GraspViews(only or "All grasps", hand, objects, _grasps(cells, states, ranks, contacts))


def _dataset_object(data: Path, name: str, tasks: Sequence[str]) -> ShownObject:
    folder, released = data / "objects" / name, data / "objects" / f"{name}.glb"
    if released.is_file():
        return load_shown_object(name, released, None, {}, _released_roles(data / PARTS, name))
    maps = {task: data / "contact_maps" / name / f"{task}.npz" for task in tasks}
    found = {task: read_contact_map(path) for task, path in maps.items() if path.is_file()}
    surface = folder / SURFACE
    return load_shown_object(
        name,
        folder / VISUAL,
        read_surface(surface) if surface.is_file() else None,
        {task: (each.points, each.normals, each.probability) for task, each in found.items()},
        _roles(folder / PROPERTIES),
    )


def _recorded(data: Path, cells: pd.DataFrame) -> list[ShownContacts]:
    """The contacts that the physics test measured, from the tables behind the dataset."""
    tables: dict[tuple[str, str], pd.DataFrame] = {}
    found = []
    for row in cells.itertuples():
        key = (row.Object, row.Intent)
        if key not in tables:
            path = data / "grasps" / row.Object / f"{row.Intent}.parquet"
            tables[key] = pd.read_parquet(path) if path.is_file() else pd.DataFrame()
        table = tables[key]
        chosen = table[table.session == row.Session] if len(table) else table
        if not len(chosen):
            found.append(ShownContacts((), np.empty((0, 3)), None))
            continue
        held = chosen.iloc[0]
        points = np.asarray(held.contact_points_m, dtype=np.float64).reshape(-1, 3)
        normals = np.asarray(held.contact_normals, dtype=np.float64).reshape(-1, 3)
        forces = normals * np.asarray(held.contact_forces_n, dtype=np.float64)[:, None]
        found.append(ShownContacts(tuple(held.contact_links), points, forces))
    return found


def _of_plan(folder: Path, hand_name: str | None) -> GraspViews:
    """The grasps of a plan's folder."""
    with parsing(folder / PLAN, "is not the summary of a plan"):
        summary = json.loads((folder / PLAN).read_text(encoding="utf-8"))
        name, task, title = summary["object"], summary["task"], summary["hand"]
        found = summary["parts"] and {
            part["part"]: part["role"] or "" for part in summary["parts"]["parts"]
        }
    hand = load_hand(hand_name) if hand_name else _titled(folder / PLAN, title)
    cells, states = read_grasp_table(folder / GRASPS, hand)
    visual, surface = folder / "object" / VISUAL, read_surface(folder / "object" / SURFACE)
    maps = {}
    if (folder / CONTACT_MAP).is_file():
        touched = read_contact_map(folder / CONTACT_MAP)
        maps[task] = (touched.points, touched.normals, touched.probability)
    shown = load_shown_object(name, visual, surface, maps, {})
    if found:
        shown = replace(shown, parts=surface_parts(surface, found, shown.parts))
    ranks = number_column(folder / GRASPS, cells.Rank).astype(int).tolist()
    cells = cells.assign(Session=number_column(folder / GRASPS, cells.Session).astype(int))
    contacts = _tested(folder / CONTACTS, "Session", cells.Session)
    grasps = _grasps(cells, states, ranks, contacts)
    return GraspViews(f"{name}, {task}", hand, {name: shown}, grasps)


def _tested(path: Path, grasp: str, numbers: Iterable[float]) -> list[ShownContacts]:
    """The contacts that the physics test measured, from the table of a plan or a release.

    Args:
        grasp: the column that numbers the grasps.
    """
    table = read_table(path, contact_schema(grasp))
    found = []
    for number in numbers:
        rows = table[table[grasp] == number]
        forces = rows[[*NORMAL_COLUMNS]].to_numpy() * rows.force_n.to_numpy()[:, None]
        points = rows[[*POINT_COLUMNS]].to_numpy()
        found.append(ShownContacts(tuple(rows.link), points, forces))
    return found


def _titled(path: Path, title: str) -> Hand:
    """The hand of the package with a title."""
    for name in hand_names():
        hand = load_hand(name)
        if hand.title == title:
            return hand
    raise InputError(path, "hand", f"{title} does not come with the package: name it with --hand")


def _grasps(
    cells: pd.DataFrame, states: HandStates, ranks: Sequence[int], contacts: Sequence[ShownContacts]
) -> list[ShownGrasp]:
    return [
        ShownGrasp(
            object=row.Object,
            task=row.Intent,
            session=row.Session,
            rank=rank,
            grasp_type=row.GraspType,
            facts={name: getattr(row, name) for name in FACTS if hasattr(row, name)},
            T_object_hand=states.T_object_hand[index],
            motion=closing_motion(states.hand, states.joint_positions[index]),
            contacts=contacts[index],
        )
        for index, (row, rank) in enumerate(zip(cells.itertuples(), ranks, strict=True))
    ]


def _released_roles(path: Path, name: str) -> dict[str, str]:
    """Role of each part of an object in a release's table of parts."""
    with parsing(path, "is not the table of parts of a release"):
        table = pd.read_csv(path, keep_default_na=False)
        table = table[table.Object == name]
        return dict(zip(table.part, table.role, strict=True))


def _roles(path: Path) -> dict[str, str]:
    """Role of each part that has one."""
    if not path.is_file():
        return {}
    roles = json.loads(path.read_text(encoding="utf-8")).get("roles", {})
    return {part: str(known["role"]) for part, known in roles.items()}
