import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

from grasptypes.files import read_npz, write_json, write_npz, zip_bytes


def test_npz_repeats_byte_for_byte_and_reads_back(tmp_path: Path) -> None:
    arrays = {"a": np.arange(6.0).reshape(2, 3), "names": np.array(["rim", "handle"])}
    write_npz(tmp_path / "one.npz", arrays)
    write_npz(tmp_path / "two.npz", arrays)
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
    back = read_npz(tmp_path / "one.npz")
    assert list(back) == ["a", "names"]
    np.testing.assert_array_equal(back["a"], arrays["a"])
    assert back["names"].tolist() == ["rim", "handle"]


def test_npz_never_pickles(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="pickle"):
        write_npz(tmp_path / "bad.npz", {"a": np.array([{}], dtype=object)})
    assert list(tmp_path.iterdir()) == []


def test_zip_tells_no_time(tmp_path: Path) -> None:
    (tmp_path / "a.zip").write_bytes(zip_bytes({"000.png": b"x", "001.png": b"y"}))
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        assert archive.namelist() == ["000.png", "001.png"]
        assert {info.date_time[0] for info in archive.infolist()} == {1980}
        assert {info.compress_type for info in archive.infolist()} == {zipfile.ZIP_STORED}


def test_a_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "table.json"
    write_json(path, {"a": 1})
    with pytest.raises(ValueError, match="JSON compliant"):
        write_json(path, {"a": float("nan")})
    assert json.loads(path.read_text()) == {"a": 1}
    assert [file.name for file in tmp_path.iterdir()] == ["table.json"]
