"""Boxes and masks, and how many objects an image shows."""

import numpy as np
import pytest
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.renders.foreground import doubts, objects_in
from grasptypes.renders.image_parts import box_of, check_box, cut, read_box, read_mask, reduced

SETTINGS = PARAMS.predict.foreground


def table(*boxes):
    """Dark things on a bright table with some noise."""
    noise = np.random.default_rng(0).normal(0, 3, (240, 320, 3))
    picture = 210 + noise
    for left, top, right, bottom in boxes:
        picture[top:bottom, left:right] = (60, 90, 120)
    return picture.clip(0, 255).astype(np.uint8)


def test_a_box_is_read_and_cut():
    assert read_box("1,2,3,4") == (1, 2, 3, 4)
    assert cut(table(), (10, 20, 50, 90)).shape == (70, 40, 3)
    check_box((0, 0, 320, 240), (240, 320), 32)
    with pytest.raises(InputError, match="320 x 240 pixels"):
        check_box((0, 0, 321, 240), (240, 320), 32)


def test_a_mask_may_be_grey_or_black_and_white_and_has_a_box(tmp_path):
    mask = np.zeros((40, 60), dtype=bool)
    mask[5:20, 30:41] = True
    for mode in ("L", "1", "RGB"):
        Image.fromarray(np.uint8(255 * mask)).convert(mode).save(tmp_path / "m.png")
        assert np.array_equal(read_mask(tmp_path / "m.png", PARAMS.predict.photos), mask)
    assert box_of(mask) == (30, 5, 41, 20)


def test_images_are_made_smaller_but_not_larger():
    assert reduced(table(), 160).shape == (120, 160, 3)
    assert reduced(table(), 500).shape == (240, 320, 3)


def test_objects_are_counted_on_a_plain_ground():
    first, second = (40, 60, 120, 180), (200, 100, 260, 160)
    assert objects_in(table(), SETTINGS) == []
    (found,) = objects_in(table(first), SETTINGS)
    assert np.abs(np.subtract(found, first)).max() <= 4
    assert len(objects_in(table(second, first), SETTINGS)) == 2
    assert doubts(table(first), SETTINGS) == ()
    assert "2 objects" in doubts(table(first, second), SETTINGS)[0]
    assert "--mask, such as --box 36," in doubts(table(first, second), SETTINGS)[0]
    assert "no object" in doubts(table(), SETTINGS)[0]


def test_a_small_object_in_a_room_is_found():
    room = table((150, 120, 190, 150))
    room[:40] = 80
    room[:, 300:] = 60
    (found,) = objects_in(room, SETTINGS)
    assert np.abs(np.subtract(found, (150, 120, 190, 150))).max() <= 4
    assert "small part of the image" in doubts(room, SETTINGS)[0]


def test_nothing_is_said_where_the_border_is_no_background():
    noise = np.random.default_rng(1).integers(0, 256, (100, 100, 3), dtype=np.uint8)
    assert objects_in(noise, SETTINGS) is None
    assert doubts(noise, SETTINGS) == ()
