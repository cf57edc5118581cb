"""Tasks in words."""

import pytest

from grasptypes.errors import InputError
from grasptypes.settings.task_words import find_task, read_lexicon
from grasptypes.settings.tasks import read_tasks

ALL = list(read_tasks())


@pytest.mark.parametrize(
    ("text", "task"),
    [
        ("handoff", "handoff"),
        ("Pour water into a glass", "pour"),
        ("she is chopping the carrots", "cut"),
        ("the big red cup is put away", "stow"),
        ("return the knife to the drawer", "stow"),
        ("return the knife to my colleague", "handoff"),
        ("use the hammer", "use"),
        ("use the hammer to pound a nail", "strike"),
    ],
)
def test_inflected_words_name_a_task(text, task):
    assert find_task(text, ALL) == task


def test_a_model_without_the_task_takes_a_use_for_use():
    assert find_task("pour water into a glass", ["use", "handoff"]) == "use"
    with pytest.raises(InputError, match="names no known task; nearest: "):
        find_task("rinse the cup", ["use", "handoff"])


@pytest.mark.parametrize("text", ["", "paint the hammer", "?!", "the drawer"])
def test_unknown_words_list_the_nearest_tasks_in_one_line(text):
    with pytest.raises(InputError) as error:
        find_task(text, ALL)
    assert "\n" not in str(error.value)
    assert all(name in ALL for name in error.value.message.split("nearest: ")[1].split(", "))


def test_nouns_and_spelling_tell_the_nearest():
    with pytest.raises(InputError, match="nearest: stow"):
        find_task("throw it into the cupboard", ALL)
    with pytest.raises(InputError, match="nearest: squeeze"):
        find_task("sqeeze it", ALL)


def test_words_that_name_two_tasks_equally_are_refused():
    with pytest.raises(InputError, match="names 2 tasks equally; nearest: cut, wash"):
        find_task("wash and chop it", ALL)


def test_the_lexicon_has_words_for_every_task():
    assert list(read_lexicon().tasks) == ALL
