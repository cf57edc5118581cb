"""Contacts of grasps as a table: one row for each point where a link presses on the object."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
import pandera.pandas as pa
from numpy.typing import ArrayLike

AXES = ("x", "y", "z")
POINT_COLUMNS = tuple(f"point_{axis}_m" for axis in AXES)
NORMAL_COLUMNS = tuple(f"normal_{axis}" for axis in AXES)
_NUMBERS = {
    **dict.fromkeys(POINT_COLUMNS, "contact in the object's frame, metres"),
    **dict.fromkeys(NORMAL_COLUMNS, "unit normal into the object"),
}


def contact_schema(grasp: str) -> pa.DataFrameSchema:
    """Schema of a table of contacts.

    Args:
        grasp: name of the column that says to which grasp a contact belongs.
    """
    return pa.DataFrameSchema(
        {
            grasp: pa.Column(int),
            "link": pa.Column(str, description="link of the hand that touches"),
            **{name: pa.Column(float, description=said) for name, said in _NUMBERS.items()},
            "force_n": pa.Column(float, pa.Check.ge(0), description="along the normal"),
        },
        strict=True,
        ordered=True,
    )


def contact_rows(
    grasp: str,
    number: int,
    links: Sequence[str],
    points_m: ArrayLike,
    normals: ArrayLike,
    forces_n: ArrayLike,
) -> pd.DataFrame:
    """The rows of one grasp.

    Args:
        grasp, number: the first column and its value.
        links: the link of each of n contacts.
        points_m, normals: (n, 3) or 3 n numbers, in the object's frame.
        forces_n: (n,) that the hand exerts along the normals.
    """
    points = np.reshape(points_m, (len(links), 3)).astype(np.float64)
    directions = np.reshape(normals, (len(links), 3)).astype(np.float64)
    return pd.DataFrame(
        {
            grasp: np.full(len(links), number, dtype=np.int64),
            "link": np.array(links, dtype=object),
            **dict(zip(POINT_COLUMNS, points.T, strict=True)),
            **dict(zip(NORMAL_COLUMNS, directions.T, strict=True)),
            "force_n": np.reshape(forces_n, len(links)).astype(np.float64),
        }
    )
