"""Photographs of objects with names: their table is checked, and their parts are read."""

import numpy as np
import pytest
from PIL import Image
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.predictors.photograph_folder import FILE, PHOTOGRAPHS, photograph_files
from grasptypes.predictors.photographs import read_photographs, shown_objects

LIMITS = PARAMS.predict.photos
HEADER = "file,object,left,top,right,bottom\n"


@pytest.fixture
def folder(tmp_path):
    picture = np.zeros((80, 120, 3), dtype=np.uint8)
    picture[20:60, 40:100] = 200
    Image.fromarray(picture).save(tmp_path / "one.png")
    (tmp_path / FILE).write_text(HEADER + "one.png,mug,40,20,100,60\none.png,mallet,0,0,40,40\n")
    return tmp_path


def test_the_part_that_shows_an_object_is_read(folder):
    assert photograph_files({PHOTOGRAPHS: str(folder)}, ["mug"])[0] == folder / FILE
    table = read_photographs(folder / FILE, ["mug"])
    (mug, inside), (mallet, corner) = shown_objects(table, folder, LIMITS)
    assert (mug, mallet) == ("mug", "mallet_s01")
    assert inside.shape == (1, 60, 60, 3)  # padded to a square
    assert inside.min() == 200
    assert corner.max() < 10 < corner.shape[1]


@pytest.mark.parametrize(
    ("row", "key"),
    [
        ("one.png,spaceship,0,0,40,40", "spaceship is neither an object nor a kind"),
        ("two.png,mug,0,0,40,40", "file: no such file: two.png"),
        ("one.png,mug,0,0,,40", "right"),
    ],
)
def test_mistakes_name_the_table_and_the_column(folder, row, key):
    (folder / FILE).write_text(HEADER + row + "\n")
    with pytest.raises(InputError, match=key) as error:
        photograph_files({PHOTOGRAPHS: str(folder)}, ["mug"])
    assert FILE in str(error.value)


@pytest.mark.parametrize("box", ["0,0,121,40", "50,0,40,40"])
def test_a_box_must_be_a_part_of_the_image(folder, box):
    (folder / FILE).write_text(f"{HEADER}one.png,mug,{box}\n")
    table = read_photographs(folder / FILE, ["mug"])
    with pytest.raises(InputError, match="120 x 80 pixels"):
        list(shown_objects(table, folder, LIMITS))


def test_without_a_folder_there_are_no_photographs():
    assert photograph_files({}, ["mug"]) == []
