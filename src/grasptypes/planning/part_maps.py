"""Study: are hands where people's hands are, on an object whose parts were found in its shape?

The contact map of the parts that were found is compared with the one of the object's true parts.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pandera.pandas as pa
from numpy.typing import NDArray

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, map_contacts
from grasptypes.contact_maps.holds import object_holds
from grasptypes.labels.grasp_type import GRASP_TYPES
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.planning.plan_contacts import grips_of, plan_contacts
from grasptypes.segmentation.evaluation import role_index
from grasptypes.segmentation.network import RoleNetwork
from grasptypes.segmentation.part_holds import part_holds
from grasptypes.segmentation.parts import find_parts
from grasptypes.settings.params import Params
from grasptypes.settings.roles import PartRole, read_roles
from grasptypes.settings.tasks import read_tasks

Array = NDArray[np.float32]

TRUE, LEFT_OUT, SHIPPED, ANYWHERE = WAYS = ("true", "left_out", "shipped", "none")
SHARE = pa.Check.in_range(0, 1)
PART_MAP_SCHEMA = pa.DataFrameSchema(
    {
        "object": pa.Column(str),
        "task": pa.Column(str),
        "parts": pa.Column(
            str,
            pa.Check.isin(WAYS),
            description="true ones; found by a network that has seen no family of the object, or "
            "by that of the package; none, every place being as good",
        ),
        "accuracy": pa.Column(
            float, SHARE, nullable=True, description="share of the surface with the right role"
        ),
        "correlation": pa.Column(
            float, pa.Check.in_range(-1, 1), description="of contact with that on the true parts"
        ),
        "right_role": pa.Column(
            float,
            SHARE,
            description="share of the people with most of the hand on roles that the task touches",
        ),
    },
    strict=True,
    ordered=True,
    unique=["object", "task", "parts"],
)


def compare_maps(
    geometry: ObjectGeometry,
    task: str,
    left_out: RoleNetwork,
    shipped: RoleNetwork,
    params: Params,
) -> list[dict[str, Any]]:
    """The rows of an object and a task, see `PART_MAP_SCHEMA`.

    Args:
        geometry: its parts have roles.
        left_out: has seen no family of the object.
        shipped: the network of the package.
    """
    # As many sessions as people, so that all of them are judged.
    people = params.contact_maps.changed(sessions=params.contact_maps.population)
    drawn = MapTask.of_object(geometry, (geometry.name, task), params.seed, people)
    known, points = read_tasks()[task], drawn.points
    part_roles = _roles(geometry)
    order = list(read_roles().roles)
    true = np.array([order.index(part.role) for part in part_roles])[points.part_index]
    touched = np.array([known.touched.get(part.role, 0.0) > 0 for part in part_roles])
    maps = {
        TRUE: (1.0, map_contacts(drawn, object_holds(drawn, geometry))),
        ANYWHERE: (np.nan, _anywhere(drawn, geometry)),
    }
    for way, network in ((LEFT_OUT, left_out), (SHIPPED, shipped)):
        parts = find_parts(points.points_m, points.normals, params.segmentation, network)
        seen, holds = part_holds(drawn, geometry, parts, known, params.segmentation)
        found = map_contacts(seen, holds) if holds else maps[ANYWHERE][1]
        maps[way] = float((role_index(parts) == true).mean()), found
    contact = {way: found.sessions.mean(axis=0) for way, (_, found) in maps.items()}
    return [
        {
            "object": geometry.name,
            "task": task,
            "parts": way,
            "accuracy": maps[way][0],
            "correlation": float(np.corrcoef(contact[way], contact[TRUE])[0, 1]),
            "right_role": share_right(maps[way][1].sessions, touched[points.part_index]),
        }
        for way in WAYS
    ]


def share_right(sessions: Array, right: NDArray[np.bool_]) -> float:
    """Share of the sessions with most of the contact on points (N,) that are right.

    Args:
        sessions: (S, N) contact of each session.
    """
    return float((sessions[:, right].sum(axis=1) > sessions.sum(axis=1) / 2).mean())


def _anywhere(drawn: MapTask, geometry: ObjectGeometry) -> ContactMap:
    """The map of people to whom every place is as good."""
    return plan_contacts(drawn, None, grips_of(GRASP_TYPES[:-1]), geometry.name).contact_map


def _roles(geometry: ObjectGeometry) -> list[PartRole]:
    """The role of each part of a surface."""
    known = geometry.properties.roles
    return [PartRole.check(known[str(name)]) for name in geometry.surface.part_names]
