"""Text of mesh files (STL, OBJ, MTL) and the statements on its lines."""

from __future__ import annotations

import codecs
import math
import re
from collections.abc import Iterator


def decoded(content: bytes) -> str:
    """The text of a mesh file; bytes of other encodings, as in names, do not matter."""
    for mark, encoding in (
        (codecs.BOM_UTF8, "utf-8-sig"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if content.startswith(mark):
            return content.decode(encoding, errors="replace")
    return content.decode("utf-8", errors="replace")


def statements(text: str) -> Iterator[tuple[int, list[str]]]:
    """Line number and words of every statement; comments are dropped, long lines joined."""
    started: list[str] = []
    lines = re.split(r"\r\n|\n|\r", text)
    for number, line in enumerate(lines, start=1):
        content = line.partition("#")[0].rstrip()
        started += content.removesuffix("\\").split()
        if started and (not content.endswith("\\") or number == len(lines)):
            yield number, [started[0].lower(), *started[1:]]
            started = []


def number(word: str) -> float:
    """The number that a word states; NaN if it states none."""
    try:
        return float(word)
    except ValueError:
        return math.nan
