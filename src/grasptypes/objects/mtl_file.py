"""Materials of a Wavefront MTL: colour, opacity, gloss and texture."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from grasptypes.objects.mesh_companions import beside, texture_name
from grasptypes.objects.parts import Material
from grasptypes.objects.surface_colours import GREY, Look
from grasptypes.objects.text_lines import decoded, number, statements


def find_looks(
    path: Path, libraries: Iterable[str], names: Sequence[str], remarks: list[str]
) -> list[Look]:
    """The look of each named material of an OBJ; grey, with a remark, where it is missing.

    Args:
        libraries: what the OBJ's `mtllib` lines name.
    """
    found: dict[str, Look] = {}
    missing = []
    for library in dict.fromkeys(libraries):
        file = beside(path, library)
        if file.is_file():
            found |= _read_looks(file, remarks)
        else:
            missing.append(f"no such file: {library}")
    if unknown := [f"'{name}'" for name in names if name not in found]:
        reason = "; ".join(missing) or "no material file defines it"
        remarks.append(f"faces of the material {', '.join(unknown)} are grey: {reason}")
    return [found.get(name, Look(GREY)) for name in names]


def _read_looks(path: Path, remarks: list[str]) -> dict[str, Look]:
    """All materials of a file by name; those with bad numbers are grey, with a remark."""
    blocks: dict[str, dict[str, tuple[int, list[str]]]] = {}
    block: dict[str, tuple[int, list[str]]] = {}
    for line, (kind, *words) in statements(decoded(path.read_bytes())):
        if kind == "newmtl":
            block = blocks.setdefault(" ".join(words), {})
        else:
            # The last of `d` and `Tr`, which mean the same, counts.
            block.pop({"d": "tr", "tr": "d"}.get(kind, ""), None)
            block[kind] = (line, words)
    return {name: _look(path, name, entries, remarks) for name, entries in blocks.items()}


def _look(
    path: Path, name: str, entries: dict[str, tuple[int, list[str]]], remarks: list[str]
) -> Look:
    def numbers(kind: str, default: float, most: float = 1.0) -> list[float]:
        """Up to three numbers from 0 to `most` of an entry; raises ValueError for others."""
        line, words = entries.get(kind, (0, [str(default)]))
        # `d -halo 0.5` depends on the direction of view.
        values = [number(word) for word in words if word != "-halo"][:3]
        if not values or not all(0 <= value <= most for value in values):
            wanted = f"numbers from 0 to {most:g}" if math.isfinite(most) else "a positive number"
            raise ValueError(f"line {line}: '{' '.join([kind, *words])[:60]}' needs {wanted}")
        return values

    try:
        colour = numbers("kd", 1.0 if "map_kd" in entries else GREY.base_color[0])
        opacity = 1 - numbers("tr", 0.0)[0] if "tr" in entries else numbers("d", 1.0)[0]
        roughness = GREY.roughness
        if "pr" in entries:
            roughness = numbers("pr", 0.0)[0]
        elif "ns" in entries and max(numbers("ks", 0.0)) > 0:
            # Blinn-Phong exponent to the width of a microfacet distribution (Walter et al. 2007,
            # section 5.2), whose square root is glTF's roughness.
            roughness = (2 / (numbers("ns", 0.0, math.inf)[0] + 2)) ** 0.25
        metallic = numbers("pm", 0.0)[0]
    except ValueError as error:
        remarks.append(f"faces of the material '{name}' are grey: {path.name}: {error}")
        return Look(GREY)
    red, green, blue = colour if len(colour) == 3 else colour[:1] * 3
    texture = _texture(path, name, entries, remarks)
    return Look(Material((red, green, blue, opacity), metallic, roughness), texture)


def _texture(
    path: Path, name: str, entries: dict[str, tuple[int, list[str]]], remarks: list[str]
) -> NDArray[np.uint8] | None:
    if "map_kd" not in entries:
        return None
    file_name = texture_name(entries["map_kd"][1])
    try:
        with Image.open(beside(path, file_name)) as image:
            return np.asarray(image.convert("RGB"))
    except (OSError, ValueError, Image.DecompressionBombError) as error:
        missing = isinstance(error, FileNotFoundError)
        reason = "no such file" if missing else "cannot be read as an image"
        remarks.append(f"the texture of the material '{name}' is missing: {file_name}: {reason}")
        return None
