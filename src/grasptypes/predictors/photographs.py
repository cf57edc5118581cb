"""Photographs of objects with names."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.kinds.names import kind_names, shape_names
from grasptypes.renders.photos import read_photo
from grasptypes.settings.commands import PhotoLimits
from grasptypes.tables import read_table

PIXEL = pa.Check.ge(0)
PHOTOGRAPH_SCHEMA = pa.DataFrameSchema(
    {
        "file": pa.Column(str, description="in the same folder"),
        "object": pa.Column(str, description="an object of the dataset, or a kind"),
        "left": pa.Column(int, PIXEL, description="of the part that shows it, pixels"),
        "top": pa.Column(int, PIXEL),
        "right": pa.Column(int, PIXEL),
        "bottom": pa.Column(int, PIXEL),
    },
    strict=True,
    ordered=True,
)


def read_photographs(path: str | Path, objects: Collection[str]) -> pd.DataFrame:
    """A table of `PHOTOGRAPH_SCHEMA`; kinds have the names of their first shapes.

    Args:
        objects: of the dataset.

    Raises:
        InputError: the table is damaged, or names something that is neither an object nor a kind.
    """
    table = read_table(path, PHOTOGRAPH_SCHEMA)
    for name in table["object"].unique():
        if name not in objects and name not in kind_names():
            raise InputError(path, "object", f"{name} is neither an object nor a kind")
    names = [name if name in objects else shape_names(name, 1)[0] for name in table["object"]]
    return table.assign(object=names)


def shown_objects(
    table: pd.DataFrame, folder: Path, limits: PhotoLimits
) -> Iterator[tuple[str, np.ndarray]]:
    """The object of each photograph, and the part that shows it, (1, S, S, 3) uint8.

    Args:
        table: of :func:`read_photographs`.
    """
    for row in table.to_dict("records"):
        box = row["left"], row["top"], row["right"], row["bottom"]
        yield row["object"], read_photo(folder / row["file"], limits, box=box)[None]
