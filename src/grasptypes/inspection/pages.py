"""An inspection as a page to turn around: parts, and where people touch the object for each
task."""

from __future__ import annotations

from grasptypes.inspection.inspection import Inspection
from grasptypes.segmentation.on_surface import role_of, with_parts
from grasptypes.viewer.grasp_views import GraspViews
from grasptypes.viewer.page import page
from grasptypes.viewer.shown_object import ShownObject, surface_parts, vertex_values


def inspection_page(inspection: Inspection) -> str:
    """One HTML page that needs no network."""
    parts = inspection.parts
    surface = with_parts(inspection.geometry.surface, inspection.drawn.points, parts)
    shown = ShownObject(
        inspection.geometry.name,
        surface_parts(surface, role_of(parts)),
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
