"""Archives of images."""

import io

import numpy as np
import pytest
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.files import write_bytes, zip_bytes
from grasptypes.renders.archives import read_named_pictures, read_pictures


def png(picture):
    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "PNG")
    return buffer.getvalue()


def test_pictures_survive_the_archive(tmp_path):
    pictures = np.random.default_rng(0).integers(0, 256, (3, 4, 5, 3), dtype=np.uint8)
    members = {f"{k:03d}.png": png(p) for k, p in enumerate(pictures)}
    write_bytes(tmp_path / "mug.zip", zip_bytes(dict(reversed(members.items()))))
    np.testing.assert_array_equal(read_pictures(tmp_path / "mug.zip"), pictures)
    named = read_named_pictures(tmp_path / "mug.zip", ["001.png"])
    np.testing.assert_array_equal(named["001.png"], pictures[1])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"no archive", "ZIP"),
        (zip_bytes({"000.png": b"no picture"}), r"000\.png"),
        (zip_bytes({"000.png": png(np.zeros((99, 99, 3), np.uint8))[:60]}), r"000\.png"),
        (zip_bytes({}), "no images"),
    ],
)
def test_damaged_archives_are_refused(tmp_path, content, message):
    write_bytes(tmp_path / "mug.zip", content)
    with pytest.raises(InputError, match=message):
        read_pictures(tmp_path / "mug.zip")
