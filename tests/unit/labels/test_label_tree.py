"""The tree as drawn is the tree that labels."""

import numpy as np
import pandas as pd

from grasptypes.labels.grasp_type import GRASP_TYPES, Measures, Thresholds, classify
from grasptypes.labels.label_tree import TREE, Branch, draw_label_tree, leaves, typical_grasps

THRESHOLDS = Thresholds(0.02, 0.05, 0.05, 0.08)
FIELDS = dict(zip(Thresholds._fields, Measures._fields, strict=True))


def test_the_drawn_tree_gives_every_grasp_the_type_of_the_rule() -> None:
    rng = np.random.default_rng(0)
    measures = Measures(*(rng.uniform(0.0, 2.0, 200) * limit for limit in THRESHOLDS))
    expected = [GRASP_TYPES[index] for index in classify(measures, THRESHOLDS)]
    found = []
    for number in range(200):
        branch: Branch | str = TREE
        while isinstance(branch, Branch):
            value = getattr(measures, FIELDS[branch.measure])[number]
            above = value > getattr(THRESHOLDS, branch.measure)
            branch = branch.above if above else branch.below
        found.append(branch)
    assert found == expected
    assert set(found) == set(leaves()) == set(GRASP_TYPES[:-1])


def test_branches_count_what_lies_below_them() -> None:
    counts = {name: number for number, name in enumerate(leaves(), start=1)}
    pictures = {leaves()[0]: np.zeros((4, 4, 3), np.uint8)}
    figure = draw_label_tree(counts, 3, THRESHOLDS, pictures)
    texts = {text.get_text() for text in figure.axes[0].texts}
    assert "palm gap\n21 grasps" in texts
    assert "enclosed diameter\n10 grasps" in texts
    assert {"≤ 20.0 mm", "> 0.050"} <= texts
    assert figure.axes[0].get_title() == "24 grasps: 21 valid, 3 rejected by physics (Invalid)"


def test_the_typical_grasp_is_valid_and_far_from_thresholds() -> None:
    rows = [
        ("Precision", 0.2, "valid"),
        ("Precision", 0.5, "valid"),
        ("Invalid", 0.9, "dropped"),
    ]
    table = pd.DataFrame(rows, columns=["GraspType", "margin", "reason"])
    typical = typical_grasps(table)
    assert {name: row.margin for name, row in typical.items()} == {"Precision": 0.5}
