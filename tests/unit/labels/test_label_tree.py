"""The drawn tree counts the grasps and shows the thresholds."""

import numpy as np
import pandas as pd
from tests.unit.labels.cases import THRESHOLDS

from grasptypes.labels.grasp_type import WAYS
from grasptypes.labels.label_tree import draw_label_tree, typical_grasps


def test_branches_count_what_lies_below_them() -> None:
    counts = {name: number for number, name in enumerate(WAYS, start=1)}
    pictures = {next(iter(WAYS)): np.zeros((4, 4, 3), np.uint8)}
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
