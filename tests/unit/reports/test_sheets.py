"""Sheets have room for every image, and text that fits."""

import numpy as np

from grasptypes.reports.sheets import INK, LEAST_PX, LINE, Group, Tile, sheet


def tile(caption: str, grey: int) -> Tile:
    return Tile(np.full((40, 80, 3), grey, np.uint8), caption)


def test_groups_start_new_rows_and_have_headings() -> None:
    line_px = round(LEAST_PX * LINE)
    groups = [
        Group("first", [tile("a", 10), tile("b", 20), tile("c", 30)]),
        Group("", [tile("d", 40)]),
    ]
    whole = sheet(groups, columns=2, height_px=20)
    assert whole.shape == (line_px + 3 * (line_px + 20), 2 * 40, 3)
    last = whole[-20:]
    assert (last[:, :40] == 40).all()
    assert (last[:, 40:] == 255).all()


def test_long_captions_are_made_to_fit() -> None:
    whole = sheet([Group("", [tile("long " * 4, 200)])], columns=1, height_px=40)
    text = whole[:-40]
    assert (text < 200).any()
    assert (text[:, -3:] == 255).all()


def test_a_sheet_without_pictures_shows_its_heading() -> None:
    whole = sheet([Group("nothing was rejected", [])], columns=4, height_px=100)
    assert (whole == int(INK[1:3], 16)).any()
