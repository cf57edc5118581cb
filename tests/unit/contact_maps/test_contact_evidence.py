"""Evidence from published poses, on a hand put where its contact is known."""

import numpy as np
import pandas as pd
import pytest
import trimesh
from tests.unit.barrett import BARRETT

from grasptypes.contact_maps.contact_evidence import (
    EVIDENCE_SCHEMA,
    SUMMARY_SCHEMA,
    object_evidence,
    pattern,
    summarise,
)
from grasptypes.objects.object_files import Surface
from grasptypes.settings.contact_maps import ContactEvidenceSettings

SETTINGS = ContactEvidenceSettings(hand_spacing_m=0.006, touch_m=0.005)


@pytest.fixture
def box():
    """A block 80 mm wide and 200 mm high, off its frame's origin, of a lower and an upper part."""
    mesh = trimesh.creation.box((0.08, 0.08, 0.2))
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.01))
    part = (fine.vertices[:, 2] > 0).astype(np.int16)
    return Surface(fine.vertices + [0.3, 0.0, 0.1], fine.faces, part, np.array(["lower", "upper"]))


def _grasp(palm_z_m, grasp_type="Power Sphere"):
    """A flat open hand above the middle of the block's top, its palm down."""
    T = np.array([[1.0, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, palm_z_m]])
    return {
        "object": "block",
        "task": "use",
        "session": 1,
        "grasp_type": grasp_type,
        "hand_configuration": np.array([0.0, *T.ravel(), 0.0, 0.0, 0.0, 0.0]),
    }


def _evidence(box, tmp_path, *grasps):
    return pd.DataFrame(
        object_evidence(
            pd.DataFrame(list(grasps)), BARRETT, box, tmp_path / "none.stl", 1.0, SETTINGS
        )
    )


def test_palm_on_the_top_touches_the_upper_part(box, tmp_path):
    row = EVIDENCE_SCHEMA.validate(_evidence(box, tmp_path, _grasp(0.203))).iloc[0]
    assert row.palm_side == "+z"
    assert row.part == "upper"
    assert row.palm_gap_mm < 4
    assert row.contact_z > 0.95
    assert row.axis == "x"


def test_palm_gap_is_the_distance_above(box, tmp_path):
    near, far = _evidence(box, tmp_path, _grasp(0.26), _grasp(0.30)).palm_gap_mm
    assert far - near == pytest.approx(40.0, abs=1.0)


def test_summary_counts_and_shares(box, tmp_path):
    rows = _evidence(
        box, tmp_path, _grasp(0.203), _grasp(0.21), _grasp(0.25), _grasp(0.25, "Precision")
    )
    summary = SUMMARY_SCHEMA.validate(summarise(rows)).set_index("grip")
    assert summary.n.to_dict() == {"enclose": 3, "pinch": 1}
    assert summary.share.sum() == pytest.approx(1.0)
    assert summary.palm_touches["pinch"] == 0.0


def test_pattern_leaves_out_invalid_and_kept_back_objects():
    rows = [
        ("mug", "Power Sphere"),
        ("mug", "Large Wrap"),
        ("mug", "Invalid"),
        ("cup", "Precision"),
    ]
    grasps = pd.DataFrame(rows, columns=["object", "grasp_type"]).assign(task="use")
    table = pattern(grasps)
    assert table["class"].unique().tolist() == ["vessels"]
    assert dict(zip(table.grip, table.share, strict=True)) == {"enclose": 0.5, "wrap": 0.5}
