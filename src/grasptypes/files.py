"""Atomic writing of files, with the same bytes for the same content, and their checksums."""

from __future__ import annotations

import hashlib
import io
import json
import os
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from grasptypes.errors import parsing

# The earliest time a ZIP archive can store: archives must not depend on when they were written.
ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)


# Suffix of files that are still being written.
TEMPORARY = ".tmp"


def file_sha256(path: str | Path) -> str:
    """SHA-256 of a file, 64 hex digits."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def staging_name(name: str) -> str:
    """What a file or folder is called while it is being written."""
    return f".{name}.{os.getpid()}{TEMPORARY}"


def write_bytes(path: str | Path, content: bytes) -> None:
    """Write ``content`` to ``path`` through a temporary file and an atomic rename."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(staging_name(path.name))
    try:
        temporary.write_bytes(content)
        os.replace(temporary, path)
    except OSError as error:  # the error of a full disk does not name the file
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: str | Path, content: str) -> None:
    """Write UTF-8 text atomically."""
    write_bytes(path, content.encode())


def write_json(path: str | Path, content: Any) -> None:
    """Write `json_text` of `content`."""
    write_text(path, json_text(content))


def json_text(content: Any) -> str:
    """JSON with sorted keys and a final newline; NaN and infinity are rejected."""
    return json.dumps(content, indent=2, sort_keys=True, allow_nan=False) + "\n"


def zip_bytes(members: Mapping[str, bytes]) -> bytes:
    """Uncompressed ZIP archive of ``members`` in order, with a fixed time stamp."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name, ZIP_EPOCH), content)
    return buffer.getvalue()


def write_npz(path: str | Path, arrays: Mapping[str, ArrayLike]) -> None:
    """Write arrays as an uncompressed ``.npz`` without time stamps or pickles."""
    members = {}
    for name, array in arrays.items():
        buffer = io.BytesIO()
        np.lib.format.write_array(buffer, np.asarray(array), allow_pickle=False)
        members[f"{name}.npy"] = buffer.getvalue()
    write_bytes(path, zip_bytes(members))


def read_npz(path: str | Path) -> dict[str, np.ndarray]:
    """Read all arrays of an ``.npz``; pickled content is never read.

    Raises:
        InputError: the file is not an ``.npz``, or damaged.
    """
    with (
        parsing(path, "cannot be read as arrays (.npz)"),
        np.load(path, allow_pickle=False) as archive,
    ):
        return {name: archive[name] for name in archive.files}
