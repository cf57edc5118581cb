"""An inspection as a page to turn around: parts, and where people touch the object for each
task."""

from __future__ import annotations

import trimesh

from grasptypes.inspection.inspection import Inspection
from grasptypes.inspection.pictures import face_parts, role_of
from grasptypes.viewer.grasp_views import GraspViews
from grasptypes.viewer.page import page
from grasptypes.viewer.shown_object import ShownObject, ShownPart, vertex_values

# What parts look like without the colours of their roles.
GREY, METALLIC, ROUGHNESS = (0.6, 0.6, 0.6), 0.0, 0.7


def inspection_page(inspection: Inspection) -> str:
    """One HTML page that needs no network."""
    surface, points = inspection.geometry.surface, inspection.drawn.points
    of_face = face_parts(surface, points, inspection.parts.part_index)
    parts = []
    for number, (name, role) in enumerate(role_of(inspection.parts).items()):
        if (faces := surface.faces[of_face == number]).size:
            mesh = trimesh.Trimesh(surface.vertices, faces, process=False)
            mesh.remove_unreferenced_vertices()
            parts.append(ShownPart(name, role, GREY, METALLIC, ROUGHNESS, mesh))
    shown = ShownObject(
        inspection.geometry.name,
        parts,
        surface,
        {
            each.task: vertex_values(
                surface,
                each.contact_map.points,
                each.contact_map.normals,
                each.contact_map.probability,
            )
            for each in inspection.tasks
            if each.contact_map
        },
    )
    return page(GraspViews(shown.name, None, {shown.name: shown}))
