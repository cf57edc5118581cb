"""From an object model to the files behind contact maps, grasps and renders."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import trimesh
from manifold3d import Manifold
from numpy.typing import NDArray

from grasptypes.files import write_bytes
from grasptypes.objects import collision, inertia, object_files, solids
from grasptypes.objects.distance_grid import DistanceGrid
from grasptypes.objects.imported_grid import imported_grid
from grasptypes.objects.object_files import Properties, Surface
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.objects.parts import ImportedModel, Material, ObjectModel, Part
from grasptypes.objects.surface_colours import SurfaceColours, linear
from grasptypes.settings.objects import Resolution


def prepare(
    name: str, imported: ImportedModel, resolution: Resolution, folder: str | Path
) -> ObjectGeometry:
    """Write an object's five files (see `object_files`)."""
    folder, parts = Path(folder), scaled_parts(imported.model, imported.scale)
    surface = part_surface(parts, resolution.surface_tolerance_m, resolution.surface_edge_m)
    properties = physical_properties(name, imported)
    hulls = collision.convex_parts([part.solid for part in parts], resolution)
    # A twentieth of the spacing is lost between the nodes anyway.
    outline = joined(parts).simplify(resolution.grid_spacing_m / 20)
    spacing_m, margin_m = resolution.grid_spacing_m, resolution.grid_margin_m
    grid = (
        imported_grid(outline, spacing_m, margin_m)
        if resolution.grid_capped
        else DistanceGrid.from_mesh(*solids.to_mesh(outline), spacing_m, margin_m)
    )
    object_files.write_surface(folder / object_files.SURFACE, surface)
    object_files.write_properties(folder / object_files.PROPERTIES, properties)
    object_files.write_collision(
        folder / object_files.COLLISION, [solids.to_mesh(hull) for hull in hulls]
    )
    grid.save(folder / object_files.DISTANCE_GRID)
    write_bytes(folder / object_files.VISUAL, visual_glb(imported, resolution.crease_deg))
    return ObjectGeometry(folder, properties)


def scaled_parts(model: ObjectModel, scale: float) -> list[Part]:
    """Return the model's parts at `scale`, as manifold3d originals whose faces can be traced."""
    return [replace(part, solid=_scaled(part.solid, scale).as_original()) for part in model.parts]


def _scaled(solid: Manifold, scale: float) -> Manifold:
    return solid.scale((scale, scale, scale))


def joined(parts: list[Part]) -> Manifold:
    """Return the union of the parts' solids."""
    return solids.union(*(part.solid for part in parts))


def face_parts(solid: Manifold, parts: list[Part]) -> NDArray[np.int16]:
    """Return for each face (F,) of the parts' union the index of the part it comes from."""
    mesh = solid.to_mesh64()
    index_of = {part.solid.original_id(): index for index, part in enumerate(parts)}
    counts = np.diff(np.asarray(mesh.run_index)) // 3
    owners = [index_of[int(original)] for original in mesh.run_original_id]
    return np.repeat(np.array(owners, dtype=np.int16), counts)


def part_surface(parts: list[Part], tolerance_m: float, edge_m: float) -> Surface:
    """Mesh the union evenly and find each vertex's part; parts with the same name count as one.

    A vertex between parts belongs to the first of them.
    """
    solid = joined(parts).simplify(tolerance_m).refine_to_length(edge_m)
    vertices, faces = solids.to_mesh(solid)
    names = list(dict.fromkeys(part.name for part in parts))
    name_of_part = np.array([names.index(part.name) for part in parts], dtype=np.int16)
    part_index = np.full(len(vertices), len(names), dtype=np.int16)
    owners = name_of_part[face_parts(solid, parts)]
    np.minimum.at(part_index, faces.reshape(-1), np.repeat(owners, 3))
    return Surface(vertices, faces, part_index, np.array(names))


def physical_properties(name: str, imported: ImportedModel) -> Properties:
    """Mass properties of the model's volume, or of its surface if it has a shell thickness."""
    model, scale = imported.model, imported.scale
    parts = scaled_parts(model, scale)
    densities = [part.density_kg_m3 or model.density_kg_m3 for part in parts]
    solid = joined(parts)
    vertices, faces = solids.to_mesh(solid)
    if model.shell_thickness_m is None:
        # Starting from the cavities keeps them out of every part.
        bodies, taken = [], _scaled(model.cavities or Manifold(), scale)
        for part, density in zip(parts, densities, strict=True):
            bodies.append(inertia.solid_masses(*solids.to_mesh(part.solid - taken), density))
            taken += part.solid
    else:
        thickness_m = model.shell_thickness_m * scale
        areal = thickness_m * np.array(densities)[face_parts(solid, parts)]
        bodies = [inertia.shell_masses(vertices, faces, areal)]
    mass, centre_m, tensor = inertia.mass_properties(inertia.together(bodies))
    factor = 1.0 if imported.mass_kg is None else imported.mass_kg / mass
    return Properties(
        object=name,
        scale=scale,
        mass_kg=mass * factor,
        centre_of_mass_m=centre_m.tolist(),
        inertia_kg_m2=(tensor * factor).tolist(),
        density_kg_m3=model.density_kg_m3 * factor,
        shell_thickness_m=model.shell_thickness_m and model.shell_thickness_m * scale,
        volume_m3=solid.volume(),
        watertight=True,
        bounds_m=[vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()],
        repairs=list(imported.repairs),
        roles={part.name: part.role.model_dump(mode="json") for part in parts if part.role},
    )


def visual_glb(imported: ImportedModel, crease_deg: float) -> bytes:
    """Return a binary glTF of the visible surface of each part, with smooth normals.

    A part whose surface has several materials has one mesh for each.
    """
    parts, solid, colours = _coloured(imported, crease_deg)
    mesh = solid.to_mesh64()
    vertices, normals = np.split(np.asarray(mesh.vert_properties)[:, :6], 2, axis=1)
    faces = np.asarray(mesh.tri_verts)
    owners = face_parts(solid, parts)
    looks = np.zeros_like(owners) if colours is None else colours.at(vertices[faces].mean(1))[0]
    scene = trimesh.Scene()
    for index, look in np.unique([owners, looks], axis=1).T.tolist():
        part, called = parts[index], f"{parts[index].name}_{index}"
        used, local = np.unique(faces[(owners == index) & (looks == look)], return_inverse=True)
        shown = trimesh.Trimesh(
            vertices[used], local.reshape(-1, 3), vertex_normals=normals[used], process=False
        )
        material, rgb = part.material, None
        if colours:
            called += f"_{look}"
            material, rgb = colours.of_vertices(look, _beside(shown))
        shown.visual = trimesh.visual.TextureVisuals(material=_pbr(part.name, material))
        if rgb is not None:
            rgba = np.column_stack([rgb, np.ones(len(rgb))])
            shown.visual.vertex_attributes["color"] = np.round(255 * rgba).astype(np.uint8)
        scene.add_geometry(shown, geom_name=called, node_name=called)
    return bytes(scene.export(file_type="glb", include_normals=True))


def _beside(mesh: trimesh.Trimesh) -> NDArray[np.float64]:
    """Points (V, 3) beside the vertices, each in one of the faces that meet there."""
    points = np.array(mesh.vertices)
    points[mesh.faces.reshape(-1)] = np.repeat(mesh.triangles_center, 3, axis=0)
    return np.asarray(0.95 * mesh.vertices + 0.05 * points)


def _coloured(
    imported: ImportedModel, crease_deg: float
) -> tuple[list[Part], Manifold, SurfaceColours | None]:
    """The parts, their union with normals, and its colours; where these vary, faces are small."""
    model, scale = imported.model, imported.scale
    parts = scaled_parts(model, scale)
    solid = joined(parts).calculate_normals(0, crease_deg)
    if model.colours is None:
        return parts, solid, None
    colours = model.colours.scaled(scale)
    # Normals come first: for many small faces they take minutes.
    return parts, solid.refine_to_length(colours.spacing_m), colours


def _pbr(name: str, material: Material) -> trimesh.visual.material.PBRMaterial:
    """The material for glTF, whose colours are linear (glTF 2.0, section 3.9.2)."""
    *srgb, opacity = material.base_color
    return trimesh.visual.material.PBRMaterial(
        name=name,
        baseColorFactor=np.round(np.append(linear(np.array(srgb)), opacity) * 255).astype(np.uint8),
        metallicFactor=material.metallic,
        roughnessFactor=material.roughness,
        alphaMode="OPAQUE" if opacity >= 1.0 else "BLEND",
    )
