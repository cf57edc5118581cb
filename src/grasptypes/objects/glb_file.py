"""Meshes and colours of a binary glTF 2.0 (GLB), each mesh with its pieces, one a material."""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image
from trimesh.visual.material import PBRMaterial

from grasptypes.errors import InputError, parsing
from grasptypes.objects.parts import Material
from grasptypes.objects.surface_colours import PAPER, FaceColours, Look, encoded

# Extensions that leave shapes alone, and the one that is decoded here.
_HARMLESS = (
    "KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_xmp", "KHR_animation_", "EXT_texture_",
    "EXT_lights_", "MSFT_texture_", "KHR_mesh_quantization",
)  # fmt: skip
# Textures that are moved, turned or scaled.
_MOVED_TEXTURE = "KHR_texture_transform"
# The file can be read without it, but shows one copy of many.
_REPEATING = "EXT_mesh_gpu_instancing"
_FLOAT, _INTEGERS = 5126, {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2"}
# Attributes that KHR_mesh_quantization may store as integers, and their numbers of columns.
_FLOATS = {"POSITION": 3, "TEXCOORD_0": 2}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6


def read_glb(
    path: Path, remarks: list[str]
) -> tuple[dict[str, list[trimesh.Trimesh]], list[FaceColours | None]]:
    """Read the meshes of the file's scene by the names of their nodes, in the scene's frame.

    Args:
        remarks: receives which textures are missing.

    Returns:
        The pieces of each mesh, and the colours of all pieces in the same order.

    Raises:
        InputError: the file is no GLB, or needs an extension or feature that is not supported.
    """
    with parsing(path, "cannot be read as a mesh"):
        header, data = _chunks(path.read_bytes())
        _check_features(path, header)
        content = _packed(header, _with_floats(header, data))
        scene = trimesh.load_scene(
            io.BytesIO(content),
            file_type="glb",
            process=False,
            resolver=trimesh.resolvers.FilePathResolver(str(path)),
        )
        placed = _placed(scene)
        _check_textures(header, scene, remarks)
        stated = sum(_triangle_counts(header))
    shown = [piece for pieces in placed.values() for piece in pieces]
    read = sum(len(mesh.faces) for mesh, _ in shown)
    if read != stated:
        raise InputError(path, "", f"has {stated} triangles, but only {read} could be read")
    meshes = {name: [mesh for mesh, _ in pieces] for name, pieces in placed.items()}
    return meshes, [colours for _, colours in shown]


def _chunks(content: bytes) -> tuple[dict[str, Any], bytes]:
    """The JSON and the binary data of a GLB."""
    magic, version, length = struct.unpack_from("<4sII", content)
    if magic != b"glTF" or version != 2:
        raise ValueError("it is not a GLB of version 2")
    if length > len(content):
        raise ValueError(f"it has {len(content)} of {length} bytes, so it is truncated")
    chunks, at = [], 12
    while at < length:
        size = struct.unpack_from("<I", content, at)[0]
        chunks.append(content[at + 8 : at + 8 + size])
        at += 8 + size
    return json.loads(chunks[0]), b"".join(chunks[1:2])


def _packed(header: dict[str, Any], data: bytes) -> bytes:
    """A GLB of JSON and binary data."""
    text = json.dumps(header).encode()
    chunks = [(b"JSON", text + b" " * (-len(text) % 4))]
    if data:
        chunks.append((b"BIN\0", data + bytes(-len(data) % 4)))
    body = b"".join(struct.pack("<I4s", len(chunk), kind) + chunk for kind, chunk in chunks)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def _nodes(header: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The nodes of the scene."""
    waiting = list(header["scenes"][header.get("scene", 0)].get("nodes", []))
    while waiting:
        node = header["nodes"][waiting.pop()]
        waiting += node.get("children", [])
        yield node


def _primitives(header: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The pieces of every mesh that the scene shows, as often as it is shown."""
    for node in _nodes(header):
        if "mesh" in node:
            yield from header["meshes"][node["mesh"]]["primitives"]


def _check_features(path: Path, header: dict[str, Any]) -> None:
    """Reject what would give no shape or a wrong one; raises InputError."""
    unknown = [e for e in header.get("extensionsRequired", []) if not e.startswith(_HARMLESS)]
    if _REPEATING in header.get("extensionsUsed", []):
        unknown.append(_REPEATING)
    if not header.get("scenes"):
        raise InputError(path, "", "has no scene, so none of its meshes is shown")
    unknown += _deformations(header)
    for primitive in _primitives(header):
        for used in (primitive["attributes"]["POSITION"], primitive.get("indices")):
            accessor = {"bufferView": None} if used is None else header["accessors"][used]
            if "bufferView" not in accessor:
                unknown += primitive.get("extensions", {})
            if "sparse" in accessor:
                unknown.append("sparse accessors")
    if unknown:
        names = ", ".join(dict.fromkeys(unknown))
        message = f"uses {names}, which cannot be read: export the mesh without it"
        raise InputError(path, "", message)


def _deformations(header: dict[str, Any]) -> Iterator[str]:
    """What gives the scene's meshes another shape than their vertices have."""
    for node in _nodes(header):
        if "mesh" in node:
            if "skin" in node:
                yield "a skeleton (skin)"
            if any(node.get("weights", header["meshes"][node["mesh"]].get("weights", []))):
                yield "a blended shape (morph target)"


def _with_floats(header: dict[str, Any], data: bytes) -> bytes:
    """Decode positions and texture coordinates stored as integers; the header is changed."""
    for name, used in (pair for p in _primitives(header) for pair in p["attributes"].items()):
        accessor = header["accessors"][used]
        if name not in _FLOATS or accessor["componentType"] == _FLOAT:
            continue
        kind = np.dtype(_INTEGERS[accessor["componentType"]])
        view = header["bufferViews"][accessor["bufferView"]]
        if view["buffer"] != 0:
            raise ValueError("its data are in another file")
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        steps = (view.get("byteStride", _FLOATS[name] * kind.itemsize), kind.itemsize)
        values = np.ndarray((accessor["count"], _FLOATS[name]), kind, data, start, steps)
        positions = values.astype(np.float64)
        if accessor.get("normalized"):
            positions = np.maximum(positions / np.iinfo(kind).max, -1)
        data += bytes(-len(data) % 4)
        floats = positions.astype("<f4").tobytes()
        header["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(data), "byteLength": len(floats)}
        )
        data += floats
        accessor |= {
            "bufferView": len(header["bufferViews"]) - 1,
            "byteOffset": 0,
            "componentType": _FLOAT,
            "normalized": False,
        }
        header["buffers"][0]["byteLength"] = len(data)
    return data


def _triangle_counts(header: dict[str, Any]) -> Iterator[int]:
    """Number of triangles of each piece, by its number of corners."""
    for primitive in _primitives(header):
        used = primitive.get("indices", primitive["attributes"]["POSITION"])
        corners = header["accessors"][used]["count"]
        mode = primitive.get("mode", _TRIANGLES)
        if mode == _TRIANGLES:
            yield corners // 3
        elif mode in (_STRIP, _FAN):
            yield max(corners - 2, 0)


def _placed(
    scene: trimesh.Scene,
) -> dict[str, list[tuple[trimesh.Trimesh, FaceColours | None]]]:
    """The scene's meshes in its frame, each with its pieces, one a material."""
    pieces: dict[str, list[tuple[trimesh.Trimesh, FaceColours | None]]] = {}
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not isinstance(mesh, trimesh.Trimesh) or not len(mesh.faces):
            continue
        is_piece = mesh.metadata.get("from_gltf_primitive")
        owner = scene.graph.transforms.parents[node] if is_piece else node
        copy = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
        copy.apply_transform(transform)
        pieces.setdefault(str(owner), []).append((copy, _colours(mesh.visual, copy.faces)))
    return pieces


def _colours(visual: Any, faces: NDArray[np.int64]) -> FaceColours | None:
    """The colours of a piece; None if it has neither material nor colours of vertices."""
    material, corners = getattr(visual, "material", None), faces.reshape(-1)
    if material is not None:
        tints, look = visual.vertex_attributes.get("color"), _look(material)
    elif visual.kind == "vertex":
        tints, look = visual.vertex_colors, Look(PAPER)
    else:
        return None
    tint = np.ones((len(corners), 3))
    if tints is not None:
        tint = trimesh.visual.color.to_float(tints)[corners, :3].astype(np.float64)
    uv = getattr(visual, "uv", None)
    places = np.zeros((len(corners), 2)) if uv is None else np.asarray(uv, np.float64)[corners]
    return FaceColours((look,), np.zeros(len(faces), dtype=np.int64), tint, places)


def _look(material: PBRMaterial) -> Look:
    """A material with the defaults of glTF 2.0, section 5.22; its factors are linear."""
    factor = material.baseColorFactor
    rgba = np.ones(4) if factor is None else np.array(factor) / 255
    red, green, blue = encoded(rgba[:3]).tolist()
    metallic = 1.0 if material.metallicFactor is None else float(material.metallicFactor)
    roughness = 1.0 if material.roughnessFactor is None else float(material.roughnessFactor)
    base = Material((red, green, blue, float(rgba[3])), metallic, roughness)
    image = material.baseColorTexture
    return Look(base, None if image is None else np.asarray(image.convert("RGB")))


def _check_textures(header: dict[str, Any], scene: trimesh.Scene, remarks: list[str]) -> None:
    """Mention textures that could not be read, or are shown in another place than stated."""
    stated = [
        material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
        for material in (
            header["materials"][p["material"]] for p in _primitives(header) if "material" in p
        )
    ]
    images = [
        getattr(getattr(mesh.visual, "material", None), "baseColorTexture", None)
        for mesh in (scene.geometry[scene.graph[node][1]] for node in scene.graph.nodes_geometry)
    ]
    missing = sum(bool(t) for t in stated) - sum(isinstance(i, Image.Image) for i in images)
    if missing > 0:
        remarks.append("a texture is missing: it cannot be read as an image")
    if any(t.get("texCoord") or _MOVED_TEXTURE in t.get("extensions", {}) for t in stated if t):
        remarks.append(f"{_MOVED_TEXTURE} and texCoord are ignored: textures may be misplaced")
