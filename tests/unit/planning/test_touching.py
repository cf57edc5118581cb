"""A plan knows which of its grasps are on parts that hands should avoid."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from grasptypes.planning import touching
from grasptypes.planning.plan_contacts import PlanContacts

TRACE = 0.05
UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("avoided", "on_blade", "valid", "expected"),
    [
        (("blade",), 2, True, True),
        # A point beside the edge.
        (("blade",), 1, True, False),
        (("blade",), 2, False, False),
        ((), 2, True, False),
    ],
)
def test_a_grasp_is_on_an_avoided_part_with_more_than_a_trace(
    monkeypatch, avoided, on_blade, valid, expected
):
    at = np.array([[0.0, 0, 0], [0.1, 0, 0]])
    contact_map = SimpleNamespace(
        points=at, normals=np.tile(UP, (2, 1)), part_index=np.array([0, 1])
    )
    contact_map.part_names = np.array(["handle", "blade"])
    points_m = np.where(np.arange(30)[:, None] < on_blade, at[1], at[0]) + 0.001 * UP
    monkeypatch.setattr(touching, "touching", lambda *rest: (points_m, np.tile(UP, (30, 1))))
    grasps = pd.DataFrame({"valid": [valid], "hand_configuration": [[0.0]]})
    contacts = PlanContacts(contact_map, (1,), avoided)
    found = touching.touches_avoided(grasps, contacts, None, None, None, TRACE)
    assert found.tolist() == [expected]
