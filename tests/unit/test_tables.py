"""Tables on their way to files and back."""

import pandas as pd
import pandera.pandas as pa
import pytest

from grasptypes.errors import InputError
from grasptypes.tables import read_table, write_table

SCHEMA = pa.DataFrameSchema(
    {"object": pa.Column(str), "share": pa.Column(float, pa.Check.in_range(0, 1))}, strict=True
)
TABLE = pd.DataFrame({"object": ["mug", "pan"], "share": [0.25, 1 / 3]})


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_what_is_written_is_read_again_and_has_the_same_bytes(tmp_path, suffix):
    first, second = (tmp_path / f"{name}.{suffix}" for name in ("first", "second"))
    write_table(TABLE, first, SCHEMA)
    found = read_table(first, SCHEMA)
    pd.testing.assert_frame_equal(found, TABLE)
    write_table(found, second, SCHEMA)
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize(
    "wrong",
    [TABLE.assign(share=[0.5, 1.5]), TABLE.drop(columns="object"), TABLE.assign(more=1)],
    ids=["range", "missing", "more"],
)
def test_a_table_that_does_not_meet_its_schema_is_not_written(tmp_path, wrong):
    with pytest.raises((pa.errors.SchemaError, pa.errors.SchemaErrors)):
        write_table(wrong, tmp_path / "table.csv", SCHEMA)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("content", "named"),
    [
        ("object,share\nmug,7\n", "share"),
        ("object,share\nmug,much\n", "share"),
        ("object\nmug\n", "'share' not in dataframe"),
        ("object,share,more\nmug,0.5,1\n", "'more' not in DataFrameSchema"),
    ],
)
def test_a_bad_file_is_named_with_its_column(tmp_path, content, named):
    path = tmp_path / "table.csv"
    path.write_text(content)
    with pytest.raises(InputError, match=f"table.csv: .*{named}"):
        read_table(path, SCHEMA)
