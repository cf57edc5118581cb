"""The rule that judges plans by true roles, what parts gain, and how contact maps are compared."""

import numpy as np
import pandas as pd
import pytest
from tests.unit.settings import PARAMS

from grasptypes.planning.part_maps import share_right
from grasptypes.planning.part_plans import (
    ANYWHERE,
    CONTACTDB,
    FOUND,
    GAIN_SCHEMA,
    YCB,
    accepts,
    contact_shares,
    summary,
)
from grasptypes.settings.roles import PartRole
from grasptypes.settings.tasks import read_tasks

SETTINGS = PARAMS.plan
HANDLE, HEAD, BLADE = (PartRole.check({"role": role}) for role in ("handle", "head", "blade"))


def test_shares_of_contact_add_up():
    shares = contact_shares([HANDLE, HEAD, HANDLE, HANDLE])
    assert dict((part.role, share) for part, share in shares) == {"handle": 0.75, "head": 0.25}


@pytest.mark.parametrize(
    ("task", "touched", "verdict"),
    [
        ("use", {HANDLE: 1.0}, (True, True, False, True)),
        ("use", {HANDLE: 0.9, BLADE: 0.1}, (True, False, False, False)),
        # A point or two beside an edge.
        ("use", {HANDLE: 0.96, BLADE: 0.04}, (True, True, False, True)),
        ("handoff", {HEAD: 0.8, HANDLE: 0.2}, (True, True, True, True)),
        ("handoff", {BLADE: 1.0}, (True, True, True, False)),
        ("strike", {HEAD: 0.6, HANDLE: 0.4}, (False, False, False, True)),
    ],
)
def test_a_grasp_is_accepted_where_people_hold_for_the_task(task, touched, verdict):
    assert accepts(list(touched.items()), read_tasks()[task], SETTINGS) == verdict


def test_the_gain_is_that_of_each_set_of_scans():
    def row(name, parts, accepted):
        counts = {"sessions": 4, "tests": 8, "valid": 4, "held": 4, "clear": 4, "handle_free": 0}
        counts |= {"offered": 4, "safe": 4, "accepted": accepted}
        return {"object": name, "task": "use", "parts": parts, **counts}

    rows = [row("mug", FOUND, 4), row("mug", ANYWHERE, 2)]
    rows += [row("ycb_mug", FOUND, 1), row("ycb_mug", ANYWHERE, 0)]
    rows += [row("ycb_knife", FOUND, 3), row("ycb_knife", ANYWHERE, 0)]
    table = GAIN_SCHEMA.validate(summary(pd.DataFrame(rows)))
    found = table[table.parts == FOUND].set_index("scans")
    assert found.gain.to_dict() == {CONTACTDB: 0.5, YCB: 0.5}
    assert found.error[YCB] == pytest.approx(0.25)
    assert found.tests_per_accepted.to_dict() == {CONTACTDB: 2.0, YCB: 4.0}


def test_a_session_is_right_with_most_of_its_contact():
    sessions = np.array([[1.0, 1.0, 0.5], [0.1, 0.0, 1.0]], dtype=np.float32)
    assert share_right(sessions, np.array([True, True, False])) == 0.5
