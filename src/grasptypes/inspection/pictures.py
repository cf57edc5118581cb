"""Images of an inspection: the parts in the colours of their roles, and where people hold them for
each task."""

from __future__ import annotations

import io
from collections.abc import Mapping

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from grasptypes.inspection.inspection import Inspection
from grasptypes.renders.contact_pictures import contact_picture, look_at, plain
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part
from grasptypes.reports.sheets import Tile
from grasptypes.segmentation.on_surface import face_normals, face_parts, role_of
from grasptypes.segmentation.parts import Parts
from grasptypes.settings.params import Params
from grasptypes.settings.renders import ContactPictureSettings

Array = NDArray[np.float64]

# Ways of holding that are listed below a contact map.
SHOWN = 4
# Parts without a role.
GREY = (0.6, 0.6, 0.6, 1.0)


def inspection_png(inspection: Inspection, params: Params) -> bytes:
    """PNG of the object in the colours of its roles, and of the contact map of each task.

    Everything is seen from two sides.
    """
    figure = draw_inspection(inspection, params)
    with io.BytesIO() as file:
        figure.savefig(file, format="png", dpi=150)
        return file.getvalue()


def draw_inspection(inspection: Inspection, params: Params) -> Figure:
    """The same as a figure: a column for the parts, and one for each task."""
    settings = params.contact_pictures
    mapped = [each for each in inspection.tasks if each.contact_map]
    colours = role_colours(inspection.parts)
    with Camera(plain(params.renders, settings.size_px)) as camera:
        views = inspection_views(inspection, camera, settings)
    figure = Figure(figsize=(4.2 * len(views), 3.0), layout="constrained")
    panels = figure.subplots(1, len(views), squeeze=False)[0]
    titles = [f"{inspection.geometry.name}: roles from {inspection.parts.basis}"]
    titles += [each.task for each in mapped]
    for panel, view, title in zip(panels, views, titles, strict=True):
        panel.imshow(view)
        panel.set_axis_off()
        panel.set_title(title, fontsize="small", parse_math=False)
    keys = [Patch(color=colour, label=role) for role, colour in colours.items()]
    panels[0].legend(handles=keys, loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=4,
                     fontsize="x-small", frameon=False)  # fmt: skip
    for panel, each in zip(panels[1:], mapped, strict=True):
        held = [f"{share:.0%} {grip} {part}" for grip, part, share in each.shares()[:SHOWN]]
        panel.text(0.5, 0.0, "\n".join(held), transform=panel.transAxes, ha="center", va="top",
                   fontsize="x-small", parse_math=False)  # fmt: skip
    return figure


def inspection_views(
    inspection: Inspection, camera: Camera, settings: ContactPictureSettings
) -> list[NDArray[np.uint8]]:
    """The parts, then the contact map of each task that has one, (H, 2 H, 3) each."""
    parts = coloured_parts(inspection, role_colours(inspection.parts))
    views = [both_sides(parts, camera, settings.azimuth_rad, settings.elevation_rad)]
    for each in inspection.tasks:
        if each.contact_map:
            values, surface = each.contact_map.probability, inspection.geometry.surface
            views.append(contact_picture(each.contact_map, values, surface, camera, settings))
    return views


def inspection_tiles(
    inspection: Inspection, camera: Camera, settings: ContactPictureSettings
) -> list[Tile]:
    """The same views with captions, for a sheet of several objects."""
    roles = ", ".join(role_colours(inspection.parts))
    captions = [f"{inspection.geometry.name}: {roles}"]
    for each in inspection.tasks:
        if each.contact_map:
            grip, part, share = each.shares()[0]
            captions.append(f"{each.task}: {share:.0%} {grip} {part}")
    views = inspection_views(inspection, camera, settings)
    return [Tile(view, caption) for view, caption in zip(views, captions, strict=True)]


def both_sides(
    parts: list[Part], camera: Camera, azimuth_rad: float, elevation_rad: float
) -> NDArray[np.uint8]:
    """Parts from two opposite directions, (H, 2 H, 3)."""
    scene, node, _ = camera.scene(parts)
    points = np.concatenate([part.vertices for part in parts])
    sides = []
    for turn in (0.0, np.pi):
        pose = look_at(points, azimuth_rad + turn, elevation_rad, camera.settings)
        scene.set_pose(node, pose)
        sides.append(camera.compose(camera.shoot(scene), points, pose))
    return np.hstack(sides)


def role_colours(parts: Parts) -> dict[str, tuple[float, float, float, float]]:
    """An sRGB colour for each role that the parts have, in their order."""
    roles = [role for role in dict.fromkeys(role_of(parts).values()) if role]
    # The ten strong colours, then the ten light ones.
    shades = [colormaps["tab20"](2 * at % 20 + at // 10) for at in range(len(roles))]
    return {role: shade for role, shade in zip(roles, shades, strict=True)}


def coloured_parts(
    inspection: Inspection, colours: Mapping[str, tuple[float, float, float, float]]
) -> list[Part]:
    """The object's surface cut by parts, each in the colour of its role."""
    surface, parts = inspection.geometry.surface, inspection.parts
    of_face = face_parts(surface, inspection.drawn.points, parts.part_index)
    found = []
    for number, role in enumerate(role_of(parts).values()):
        corners = surface.vertices[surface.faces[of_face == number]]
        if len(corners):
            normals = face_normals(corners)
            triangles = np.arange(3 * len(corners)).reshape(-1, 3)
            colour = np.array(colours.get(role, GREY)[:3]) ** 2.2
            found.append(
                Part(
                    corners.reshape(-1, 3),
                    np.repeat(normals, 3, axis=0),
                    triangles,
                    colour,
                    0.0,
                    0.9,
                )
            )
    return found
