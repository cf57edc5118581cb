"""Reading and writing of tables, checked against a schema."""

from __future__ import annotations

import io
from pathlib import Path

import pandas as pd
import pandera.pandas as pa

from grasptypes.errors import InputError
from grasptypes.files import write_bytes


def write_table(table: pd.DataFrame, path: str | Path, schema: pa.DataFrameSchema) -> None:
    """Check ``table`` against ``schema`` and write it as CSV or Parquet, by the file's suffix.

    Raises:
        pandera.errors.SchemaError: the table violates its schema; nothing is written.
    """
    path = Path(path)
    checked = schema.validate(table)
    buffer = io.BytesIO()
    if path.suffix == ".parquet":
        checked.to_parquet(buffer, index=False, compression="zstd")
    else:
        checked.to_csv(buffer, index=False, lineterminator="\n")
    write_bytes(path, buffer.getvalue())


def read_table(path: str | Path, schema: pa.DataFrameSchema) -> pd.DataFrame:
    """Read a table written by :func:`write_table` and check it.

    Raises:
        InputError: names the file and the first column that violates the schema.
    """
    path = Path(path)
    try:
        table = pd.read_parquet(path) if path.suffix == ".parquet" else pd.read_csv(path)
    except (OSError, ValueError, pd.errors.ParserError) as error:
        raise InputError(path, "", f"cannot be read as a table: {error}") from error
    try:
        return schema.validate(table)
    except (pa.errors.SchemaError, pa.errors.SchemaErrors) as error:
        # Extra columns are reported as a collection of errors, even a single one.
        first = getattr(error, "schema_errors", [error])[0]
        column = getattr(first.schema, "name", None) or str(first.reason_code)
        raise InputError(path, str(column), str(first)) from error
