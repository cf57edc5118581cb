"""Files that a Wavefront OBJ names: its materials, and their textures."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from grasptypes.objects.text_lines import decoded, number, statements

# Options of a texture that one word follows, and those that up to this many numbers follow. Their
# effects are ignored.
_OPTIONS = ("-blendu", "-blendv", "-cc", "-clamp", "-imfchan", "-type")
_NUMBERED = {"-bm": 1, "-boost": 1, "-mm": 2, "-o": 3, "-s": 3, "-t": 3, "-texres": 1}


def library_names(words: Sequence[str]) -> list[str]:
    """The files that an `mtllib` statement names: several, or one whose name has spaces."""
    whole = " ".join(words)
    return [whole] if whole.lower().count(".mtl") < 2 else list(words)


def texture_name(words: Sequence[str]) -> str:
    """The file that a `map_Kd` statement names, without its options; it may have spaces."""
    left = list(words)
    while left and left[0] in (*_OPTIONS, *_NUMBERED):
        option = left.pop(0)
        if option in _OPTIONS:
            del left[:1]
        for _ in range(_NUMBERED.get(option, 0)):
            if len(left) > 1 and not math.isnan(number(left[0])):
                del left[0]
    return " ".join(left)


def beside(path: Path, name: str) -> Path:
    """A file that another one names, perhaps with separators of another system."""
    return path.parent / name.replace("\\", "/")


def companions(path: str | Path) -> list[str]:
    """The existing files that an OBJ needs for its colours; none for other formats."""
    path = Path(path)
    if path.suffix.lower() != ".obj" or not path.is_file():
        return []
    libraries = [beside(path, name) for name in _named(path, "mtllib")]
    textures = [
        beside(library, name)
        for library in libraries
        if library.is_file()
        for name in _named(library, "map_kd")
    ]
    return sorted({str(file) for file in [*libraries, *textures] if file.is_file()})


def _named(path: Path, wanted: str) -> Iterator[str]:
    for _, (kind, *words) in statements(decoded(path.read_bytes())):
        if kind == wanted:
            yield from library_names(words) if kind == "mtllib" else [texture_name(words)]
