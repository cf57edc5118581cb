"""The optional folder of photographs that the user names.

What reads the table is imported only if there is one: the workflow starts faster.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from grasptypes.errors import InputError

PHOTOGRAPHS = "GRASPTYPES_PHOTOGRAPHS"
FILE = "photographs.csv"


def photograph_files(environment: Mapping[str, str], objects: Collection[str]) -> list[Path]:
    """The table in the folder that the environment names, and the files that it lists.

    Args:
        objects: of the dataset.

    Returns:
        the table first; nothing if no folder is named.

    Raises:
        InputError: the folder has no such table, or it is wrong.
    """
    named = environment.get(PHOTOGRAPHS, "")
    if not named:
        return []
    path = Path(named) / FILE
    if not path.is_file():
        raise InputError(PHOTOGRAPHS, "", f"names '{named}', which is not a folder with a {FILE}")
    from grasptypes.predictors.photographs import read_photographs

    files = [path.parent / name for name in read_photographs(path, objects)["file"].unique()]
    for file in files:
        if not file.is_file():
            raise InputError(path, "file", f"no such file: {file.name}")
    return [path, *files]
