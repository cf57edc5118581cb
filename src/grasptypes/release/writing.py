"""Write a release of the dataset.

``python -m grasptypes.release.writing FOLDER``, in a checkout.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import struct
import sys
from importlib.metadata import version
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.files import file_sha256, staging_name, write_bytes, write_json, write_text
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.objects.object_files import COLLISION, VISUAL
from grasptypes.release.description import describe
from grasptypes.release.reading import CHECKSUMS, DESCRIPTION
from grasptypes.release.tables import part_roles, release_tables
from grasptypes.settings.params import checkout_params

LOADER = "load_dataset.py"


def write_release(root: Path, folder: Path) -> None:
    """Write a release of a checkout's dataset to a new folder, completely or not at all.

    Raises:
        InputError: something is not computed yet, or the folder is not empty.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(folder, "", "already exists and is not empty")
    folder = folder.resolve()
    staged = folder.with_name(staging_name(folder.name))
    staged.mkdir(parents=True)
    try:
        _write_files(root, staged)
        os.replace(staged, folder)
    finally:
        shutil.rmtree(staged, ignore_errors=True)


def _write_files(root: Path, folder: Path) -> None:
    params, data = checkout_params(root), root / "data"
    hand = load_hand(params.hand, root)
    tables = release_tables(data, hand, params.grasp_types.fitted_on)
    for name, table in tables.items():
        write_text(folder / f"{name}.csv", table.to_csv(index=False, lineterminator="\n"))
    tables["grasps"].to_parquet(folder / "grasps.parquet", index=False, compression="zstd")
    for name in tables["objects"].Object:
        _copy_object(data, str(name), folder)
    _copy_hand(hand, folder / "hands" / Path(hand.folder).name)
    _copy(root / "LICENSE", folder / "LICENSE")
    _copy(Path(__file__).with_name(LOADER), folder / LOADER)
    write_text(folder / "datasheet.md", _without_links((root / "docs/datasheet.md").read_text()))
    write_json(folder / DESCRIPTION, describe(folder, tables, version("grasptypes")))
    _write_checksums(folder)


def _copy(source: Path, target: Path) -> None:
    if not source.is_file():
        raise InputError(source, "", "is missing; compute it with: make release")
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)


def _copy_object(data: Path, name: str, folder: Path) -> None:
    source = data / "objects" / name
    glb = with_parts((source / VISUAL).read_bytes(), part_roles(data, name))
    write_bytes(folder / "objects" / f"{name}.glb", glb)
    _copy(source / COLLISION, folder / "objects" / f"{name}_collision.obj")
    for kind in ("renders", "screenshots"):
        _copy(data / kind / f"{name}.zip", folder / "images" / kind / f"{name}.zip")


def _copy_hand(hand: Hand, folder: Path) -> None:
    source = Path(hand.folder)
    for path in sorted(source.rglob("*")):
        if path.is_file():
            _copy(path, folder / path.relative_to(source))


def with_parts(glb: bytes, roles: dict[str, str]) -> bytes:
    """A GLB whose nodes say which part they are, and its role: glTF 2.0's `extras`."""
    (length,) = struct.unpack_from("<I", glb, 12)
    header, rest = json.loads(glb[20 : 20 + length]), glb[20 + length :]
    for node in header["nodes"]:
        if "mesh" in node:
            part = node["name"].rsplit("_", 1)[0]
            node["extras"] = {"part": part} | ({"role": roles[part]} if part in roles else {})
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    start = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
    return start + struct.pack("<I4s", len(text), b"JSON") + text + rest


def _without_links(text: str) -> str:
    """Markdown without links to files that are not in the release."""
    return re.sub(r"\[([^]]+)\]\((?!http)[^)]+\)", r"\1", text)


def _write_checksums(folder: Path) -> None:
    files = sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    lines = [f"{file_sha256(folder / path)}  {path.as_posix()}\n" for path in files]
    write_text(folder / CHECKSUMS, "".join(lines))


if __name__ == "__main__":
    try:
        write_release(Path(), Path(sys.argv[1]))
    except InputError as error:
        sys.exit(f"error: {error}")
