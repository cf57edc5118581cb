"""Blocks of own tasks are checked before anything runs."""

import pytest

from grasptypes.errors import InputError
from grasptypes.predictors.features import NO_TASK
from grasptypes.predictors.own_tasks import RESERVED, check_tasks

TASKS = {"use": {"colour_shift": 10}, "handoff": {"colour_shift": -10}}


def test_any_number_of_tasks_passes():
    check_tasks({"use": TASKS["use"]})
    check_tasks(TASKS | {"wash": {"colour_shift": -20}, "show": {"colour_shift": 0}})


def test_tasks_that_look_alike_are_refused():
    with pytest.raises(InputError) as raised:
        check_tasks(TASKS | {"wash": {"colour_shift": 10}})
    assert str(raised.value) == (
        "params.yaml: tasks.wash.colour_shift: 10 is that of use too: "
        "no picture could tell them apart"
    )


def test_the_name_of_no_task_is_refused():
    assert RESERVED == NO_TASK
    with pytest.raises(InputError, match=r"tasks\.none: stands for no task"):
        check_tasks({"none": {"colour_shift": 0}})
