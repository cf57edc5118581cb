"""The dataset's table and the samples counted from it."""

import numpy as np
import pandas as pd
import pytest
from tests.unit.barrett import BARRETT
from tests.unit.labels.cases import RULE, Ball

from grasptypes.errors import InputError
from grasptypes.hands import configuration
from grasptypes.labels.dataset import dataset_schema, dataset_table, label_grasps, sample_table
from grasptypes.labels.published import read_published
from grasptypes.labels.samples import SAMPLE_SCHEMA


def grasps(valid=(True, True, False), name="ball"):
    """Hands in front of a ball: palm on it, fingertips on it, and one that dropped it."""
    dofs = np.radians([[60, 90, 90, 85], [0, 60, 60, 60], [0, 60, 60, 60]])
    T = np.broadcast_to(np.eye(4), (3, 4, 4)).copy()
    T[:, 2, 3] = -0.041, -0.09, -0.09
    return pd.DataFrame(
        {
            "object": name,
            "task": ["use", "use", "handoff"],
            "session": [2, 1, 1],
            "rank": [0, 3, 0],
            "energy": [-1.0, -2.0, -3.0],
            "hand_configuration": configuration.pack(0, T, dofs).tolist(),
            "joint_angles_rad": BARRETT.couple(dofs).tolist(),
            "stopped_joints": [[0, 1, 0]] * 3,
            "touching_pose": T[:, :3].reshape(3, 12).tolist(),
            "touching_joints": BARRETT.couple(dofs).tolist(),
            "pregrasp_pose": T[:, :3].reshape(3, 12).tolist(),
            "pregrasp_joints": [[0.0] * 8] * 3,
            "penetration_m": 0.001,
            "bears_load": True,
            "valid": list(valid),
            "reason": ["" if one else "dropped" for one in valid],
            "tries": [1, 4, 10],
        }
    )


def made(**changes):
    return dataset_table([label_grasps(grasps(**changes), BARRETT, Ball(0.04), RULE)], BARRETT)


def test_every_row_is_complete_and_meets_the_schema():
    table = dataset_schema(BARRETT).validate(made())
    assert not table.isna().any(axis=None)
    assert table.Index.tolist() == [0, 1, 2]
    assert table[["Intent", "Session"]].to_numpy().tolist() == [
        ["handoff", 1],
        ["use", 1],
        ["use", 2],
    ]


def test_labels_and_reasons():
    table = made()
    assert table.GraspType.tolist() == ["Invalid", "Precision", "Power Sphere"]
    assert table.GraspTypeIndex.tolist() == [7, 6, 4]
    assert table.reason.tolist() == ["dropped", "valid", "valid"]
    assert table["shape"].tolist() == ["Precision", "Precision", "Power Sphere"]
    assert table.virtual_fingers.tolist() == [2, 2, 3]
    assert table.Rank.tolist() == [1, 4, 1]


def test_the_table_can_be_read_as_the_published_one(tmp_path):
    made().to_csv(tmp_path / "grasps.csv", index=False)
    read = read_published(tmp_path / "grasps.csv")
    assert read.grasp_type.tolist() == ["Invalid", "Precision", "Power Sphere"]
    assert read.image[0] == "screenshots/ball_1_handoff.png"


def test_samples_count_valid_grasps_only():
    samples = SAMPLE_SCHEMA.validate(sample_table(made(valid=(True, True, True))))
    use = samples.set_index("task").loc["use"]
    assert use.n_valid == 2
    assert use.count_power_sphere == use.count_precision == 1
    assert use.probability_precision == 0.5
    assert use.label_large_wrap == 0


def test_a_sample_without_valid_grasp_is_named():
    with pytest.raises(InputError, match="ball, handoff"):
        sample_table(made())


def test_pairs_with_few_valid_grasps_may_be_left_out():
    assert sample_table(made(), least=1).task.tolist() == ["use"]
