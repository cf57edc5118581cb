"""The loads of tasks: the table of the checkout is right, and mistakes in a table are named."""

import numpy as np
import pytest
from synthesis_cases import ball_object, palm_at

from grasptypes.errors import InputError
from grasptypes.physics.loads import COLUMNS, task_load

TABLE = "assets/task_loads.csv"


def written(tmp_path, *rows):
    path = tmp_path / "loads.csv"
    path.write_text("\n".join([",".join(COLUMNS), *rows]) + "\n")
    return path


def test_an_object_without_a_row_gets_the_task_s_own(tmp_path) -> None:
    ball = ball_object(tmp_path, centre_m=(0.0, 0.0, 0.01))
    load = task_load(TABLE, ball, "handoff")
    assert load is not None
    np.testing.assert_allclose(load.point_m, [0.0, 0.0, 0.01])
    # Away from the palm, whichever way the hand looks.
    np.testing.assert_allclose(load.force(palm_at(0.1)[0]), [0.0, 0.0, load.force_n])
    assert task_load(TABLE, ball, "juggle") is None


def test_a_direction_of_the_object_turns_with_it(tmp_path) -> None:
    path = written(tmp_path, "*,use,*,-z,1,heavy", "ball,use,*,+y,2,its own row counts")
    load = task_load(path, ball_object(tmp_path), "use")
    assert load is not None
    np.testing.assert_allclose(load.force(palm_at(0.1)[0]), [0.0, -2.0, 0.0])


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("*,use,*,up,1,why", "row 2, direction: 'up'"),
        ("*,use,*,+x,much,why", "row 2, force_n: 'much' is not a number"),
        ("*,use,*,+x,-1,why", "row 2, force_n: must be 0 to 1000 N"),
        ("*,use,*,+x,1,", "row 2, reason: is empty"),
        ("*,use,*,+x,1", "row 2: needs 6 cells"),
        ("ball,use,lid,+x,1,why", "row 2, part: 'lid'"),
    ],
)
def test_mistakes(tmp_path, row, said) -> None:
    from grasptypes.objects.object_files import SURFACE, Surface, write_surface

    ball = ball_object(tmp_path)
    points = np.zeros((1, 3))
    surface = Surface(points, np.zeros((0, 3), np.int32), np.zeros(1, np.int16), np.array(["ball"]))
    write_surface(tmp_path / SURFACE, surface)
    with pytest.raises(InputError) as caught:
        task_load(written(tmp_path, row), ball, "use")
    assert said in str(caught.value)


def test_two_rows_for_one_object_and_task_are_a_mistake(tmp_path) -> None:
    path = written(tmp_path, "*,use,*,+x,1,why", "*,use,*,+y,1,why not")
    with pytest.raises(InputError, match=r"row 3: .* is also in row 2"):
        task_load(path, ball_object(tmp_path), "use")
