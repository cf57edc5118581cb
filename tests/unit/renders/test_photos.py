"""What users hand in: good images whatever their format, and one clear line for the others."""

import struct

import numpy as np
import pytest
from PIL import Image

from grasptypes.errors import InputError
from grasptypes.renders.photos import (
    PhotoLimits,
    check_photo,
    padded,
    photo_files,
    read_background,
    read_photo,
)

LIMITS = PhotoLimits(min_px=32, max_pixels=1_000_000, reduce_px=128)
NOISE = np.random.default_rng(0).integers(0, 256, (64, 64, 3), dtype=np.uint8)
ALPHA = np.where(np.arange(64) < 32, 255, 0) * np.ones((64, 1))  # the right half is transparent
TRANSPARENT = np.dstack([NOISE, ALPHA.astype(np.uint8)])


@pytest.mark.parametrize("mode", ["RGB", "L", "P", "1", "CMYK"])
def test_opaque_modes_are_read(tmp_path, mode):
    suffix = "tiff" if mode == "CMYK" else "png"
    Image.fromarray(NOISE).convert(mode).save(tmp_path / f"a.{suffix}")
    photo = read_photo(tmp_path / f"a.{suffix}", LIMITS)
    assert photo.shape == (64, 64, 3)
    assert photo.dtype == np.uint8
    if mode == "RGB":
        assert (photo == NOISE).all()


def test_a_large_picture_is_reduced_and_keeps_its_proportions(tmp_path):
    wide = np.zeros((200, 400, 3), np.uint8)
    wide[:, :200] = 255
    Image.fromarray(wide).save(tmp_path / "a.png")
    photo = read_photo(tmp_path / "a.png", LIMITS)
    assert photo.shape == (128, 128, 3)
    assert photo[64, 10].tolist() == [255, 255, 255]
    assert photo[64, 120].tolist() == [0, 0, 0]


def test_a_camera_s_turn_is_undone(tmp_path):
    picture = Image.fromarray(NOISE)
    exif = picture.getexif()
    exif[0x0112] = 3  # upside down
    picture.save(tmp_path / "a.png", exif=exif)
    assert (read_photo(tmp_path / "a.png", LIMITS) == NOISE[::-1, ::-1]).all()


def test_padding_has_the_colour_of_the_border():
    picture = np.full((40, 80, 3), 7, np.uint8)
    picture[10:30, 20:60] = 200
    square = padded(picture)
    assert square.shape == (80, 80, 3)
    assert (square[:20] == 7).all()
    assert (square[20:60] == picture).all()


def _bad(folder):
    """Files that are no usable image; more of them are in tests/bad_input."""
    Image.fromarray(NOISE).save(folder / "whole.png")
    whole = (folder / "whole.png").read_bytes()
    (folder / "truncated.png").write_bytes(whole[: len(whole) // 2])
    (folder / "header.png").write_bytes(whole[:40])
    Image.fromarray(NOISE).save(folder / "whole.jpg")
    (folder / "truncated.jpg").write_bytes((folder / "whole.jpg").read_bytes()[:900])
    Image.fromarray(NOISE[:1, :1]).save(folder / "dot.png")
    Image.fromarray(TRANSPARENT).save(folder / "alpha.png")
    grey = Image.fromarray(NOISE).convert("L")
    grey.save(folder / "key.png", transparency=grey.getpixel((0, 0)))
    (folder / "folder.png").mkdir()
    more = {"save_all": True, "append_images": [Image.fromarray(NOISE[::-1])]}
    for name in ("moving.png", "moving.webp"):
        Image.fromarray(NOISE).save(folder / name, **more)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("header.png", "not an image"),
        ("truncated.jpg", "cannot be read as an image"),
        ("key.png", "has transparent pixels"),
        ("folder.png", "cannot be read as an image"),
        ("moving.png", "contains several images"),
        ("moving.webp", "contains several images"),
    ],
)
def test_bad_pictures_are_refused_in_one_line(tmp_path, name, expected):
    _bad(tmp_path)
    with pytest.raises(InputError) as raised:
        read_photo(tmp_path / name, LIMITS)
    line = str(raised.value)
    assert line.startswith(str(tmp_path / name))
    assert expected in line
    assert "\n" not in line


@pytest.mark.parametrize("mode", ["RGBA", "LA"])
def test_an_alpha_channel_that_hides_nothing_is_ignored(tmp_path, mode):
    grey = Image.fromarray(NOISE).convert("L")
    grey.convert(mode).save(tmp_path / "a.png")
    grey.save(tmp_path / "b.png")
    check_photo(tmp_path / "a.png", LIMITS)
    same = (read_photo(tmp_path / name, LIMITS) for name in ("a.png", "b.png"))
    assert np.array_equal(*same)


def test_transparent_pixels_show_the_background(tmp_path):
    _bad(tmp_path)
    with pytest.raises(InputError, match="--background white"):
        check_photo(tmp_path / "alpha.png", LIMITS)
    check_photo(tmp_path / "alpha.png", LIMITS, (255, 0, 0))
    photo = read_photo(tmp_path / "alpha.png", LIMITS, (255, 0, 0))
    assert (photo[:, :32] == NOISE[:, :32]).all()
    assert (photo[:, 32:] == (255, 0, 0)).all()


def test_a_background_is_an_opaque_colour():
    assert read_background("white") == (255, 255, 255)
    for colour in ("whyte", "#ffffff00"):
        with pytest.raises(InputError, match="--background"):
            read_background(colour)


def test_a_header_is_looked_at_alone(tmp_path):
    _bad(tmp_path)
    check_photo(tmp_path / "truncated.png", LIMITS)
    with pytest.raises(InputError, match="at least 32"):
        check_photo(tmp_path / "dot.png", LIMITS)


def test_of_a_phone_s_several_pictures_the_first_is_taken(tmp_path):
    other = Image.fromarray(NOISE[::-1])
    Image.fromarray(NOISE).save(tmp_path / "a.jpg", "MPO", save_all=True, append_images=[other])
    Image.fromarray(NOISE).save(tmp_path / "b.jpg")
    one, other = (read_photo(tmp_path / name, LIMITS) for name in ("a.jpg", "b.jpg"))
    assert (one == other).all()


def test_a_folder_gives_its_files_by_name_whatever_they_are_called(tmp_path):
    names = ("a.jpg", "b.PNG", "e.jfif", "f.pgm", "g.JPE", "h.HEIC", "i", "notes.txt")
    for name in (*names, ".c.png", "._a.jpg"):
        (tmp_path / name).touch()
    (tmp_path / "d.png").mkdir()
    files, skipped = photo_files(tmp_path)
    assert [file.name for file in files] == sorted(names)
    assert {file.name: reason for file, reason in skipped.items()} == {
        ".c.png": "a hidden file",
        "._a.jpg": "a hidden file",
        "d.png": "not a file",
    }
    assert photo_files(tmp_path / "a.jpg") == ([tmp_path / "a.jpg"], {})


@pytest.mark.parametrize(
    "entry",
    [
        (0x11A, 5, 1, 0, 0),  # a resolution of 0/0
        (0x128, 11, 1, 0, 0x3F8),  # a unit that is a fraction
        (0x128, 8, 1, 0xFFFF, 0xFFFF),  # a negative unit
        (0x11A, 7, 5, 38, 0),  # a resolution of five bytes
        (0x10F, 2, 0x7FFFFFFF, 38, 0),  # a camera's name of 2 GB
    ],
    ids=["0/0", "fraction", "negative", "bytes", "long"],
)
def test_damaged_metadata_cost_neither_the_photo_nor_its_turn(tmp_path, entry):
    turned = struct.pack("<HHIHH", 0x112, 3, 1, 6, 0)
    fields = [turned, struct.pack("<HHIHH", *entry)]
    exif = b"Exif\0\0II*\0\x08\0\0\0\2\0" + b"".join(fields) + bytes(20)
    Image.fromarray(NOISE).save(tmp_path / "a.jpg", exif=exif, quality=95)
    Image.fromarray(NOISE).save(tmp_path / "b.jpg", quality=95)
    one, other = (read_photo(tmp_path / name, LIMITS) for name in ("a.jpg", "b.jpg"))
    assert (one == np.rot90(other, -1)).all()


def test_metadata_that_cannot_be_read_do_not_matter(tmp_path):
    Image.fromarray(NOISE).save(tmp_path / "a.jpg", exif=b"Exif\0\0\0\x08no TIFF")
    Image.fromarray(NOISE).save(tmp_path / "b.jpg")
    one, other = (read_photo(tmp_path / name, LIMITS) for name in ("a.jpg", "b.jpg"))
    assert (one == other).all()


def test_nothing_there_is_said(tmp_path):
    with pytest.raises(InputError, match="no such file or folder"):
        photo_files(tmp_path / "gone.png")
    (tmp_path / ".hidden.png").touch()
    with pytest.raises(InputError, match="contains no image"):
        photo_files(tmp_path)
