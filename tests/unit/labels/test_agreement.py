"""Agreement with people: tables, fit, and the published poses where they are at hand."""

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from grasptypes.labels.agreement import (
    AGREEMENT_SCHEMA,
    THRESHOLD_SCHEMA,
    THRESHOLDS,
    TYPES,
    PublishedMeasures,
    agreement,
    confusion,
    cross_validate,
    describe_fit,
    fit_thresholds,
    measure_published,
)
from grasptypes.labels.grasp_type import Measures, classify
from grasptypes.labels.published import read_published
from grasptypes.labels.published_objects import object_distances
from grasptypes.settings.grasp_types import ContactSettings, Softness, Thresholds
from grasptypes.settings.params import read_params

ROOT = Path(__file__).parents[3]
TRUE = Thresholds(palm_gap_m=0.020, small_diameter_m=0.050, sideways_share=0.05, large_span_m=0.080)
LIMITS = [getattr(TRUE, name) for name in THRESHOLDS]
SOFTNESS = Softness(**dict.fromkeys(THRESHOLDS, 0.1))


def made_up(count=600, objects=("mug", "pan", "cup")):
    """Grasps spread evenly about known thresholds, labelled by them."""
    draw = np.random.default_rng(1)
    measures = Measures(*(limit * np.exp(draw.uniform(-1, 1, count)) for limit in LIMITS))
    names = np.array([objects[index % len(objects)] for index in range(count)])
    return PublishedMeasures(names, classify(measures, TRUE), measures)


def test_a_row_an_object_and_one_for_all():
    judged = PublishedMeasures(
        np.array(["a", "a", "b", "b"]),
        np.array([0, 1, 2, 2]),
        Measures(*np.ones((4, 4))),
    )
    table = agreement(judged, np.array([0, 0, 2, 2]), ["2 objects, this one too"] * 4)
    AGREEMENT_SCHEMA.validate(table)
    assert table.object.tolist() == ["a", "b", "all"]
    assert table.accuracy.tolist() == [0.5, 1.0, 0.75]
    assert table.kappa.tolist() == [0.0, 1.0, 0.6]


def test_confusion_counts_people_in_rows():
    judged = PublishedMeasures(np.array(["a"] * 3), np.array([0, 0, 5]), Measures(*np.ones((4, 3))))
    counts = confusion(judged, np.array([0, 3, 5]))
    assert counts[0, 0] == counts[0, 3] == counts[5, 5] == 1
    assert counts.sum() == 3


def test_the_fit_finds_thresholds_that_made_the_labels():
    fitted = fit_thresholds(made_up(), SOFTNESS)
    np.testing.assert_allclose([getattr(fitted, name) for name in THRESHOLDS], LIMITS, rtol=0.12)


def test_cross_validation_labels_each_object_without_its_own_poses():
    judged = made_up(300)
    # One object whose labels follow other thresholds: it must not pull its own along.
    odd = judged.objects == "pan"
    labels = np.where(odd, (judged.labels + 1) % len(TYPES), judged.labels)
    table = cross_validate(judged._replace(labels=labels), SOFTNESS)
    THRESHOLD_SCHEMA.validate(table)
    scores = table.set_index("object").accuracy
    assert scores["pan"] < 0.1
    assert scores["mug"] > 0.85
    assert (table.fitted_on == "2 other objects").all()


def test_words_for_the_fit():
    assert describe_fit(["mug", "pan"], ["mug", "cup"]) == [
        "2 objects, this one too",
        "2 other objects",
    ]


def test_judge_leaves_out_what_has_no_type_configuration_or_object():
    numbers = np.array([0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -0.1, 0, 1, 1, 1])
    table = pd.DataFrame(
        {
            "object": ["ball", "ball", "ball", "other"],
            "grasp_type": ["Precision", "Invalid", "Precision", "Precision"],
            "hand_configuration": pd.Series([numbers, numbers, None, numbers], dtype=object),
        }
    )

    class Ball:
        def distance_and_gradient(self, points):
            length = np.linalg.norm(points, axis=-1)
            return length - 0.03, points / length[..., None]

    judged = measure_published(
        table,
        {"ball": Ball()},
        ContactSettings(
            surface_spacing_m=0.01, patch_depth_m=0.002, reach_m=0.02, closing_weight=3.0
        ),
    )
    assert judged.objects.tolist() == ["ball"]
    assert judged.labels.tolist() == [TYPES.index("Precision")]
    assert judged.measures.palm_gap_m[0] == pytest.approx(0.07, abs=2e-3)


@pytest.fixture(scope="module")
def published_grasps():
    csv = os.environ.get("GRASPTYPES_PUBLISHED_CSV", "")
    meshes = os.environ.get("GRASPTYPES_REFERENCE_MESHES", "")
    if not (csv and meshes):
        pytest.skip("GRASPTYPES_PUBLISHED_CSV or GRASPTYPES_REFERENCE_MESHES is not set")
    params = read_params(ROOT / "params.yaml")
    published = read_published(csv)
    names = sorted(path.stem for path in Path(meshes).glob("*.stl"))
    fields = object_distances(names, meshes, "none", params.replay.object_scale, {})
    settings = params.grasp_types
    return measure_published(published, fields, settings.contacts), settings


def test_landed_thresholds_agree_with_people(published_grasps):
    judged, settings = published_grasps
    predicted = classify(judged.measures, settings.thresholds)
    right = pd.Series(predicted == judged.labels).groupby(judged.objects).mean()
    assert len(right) == 11
    assert np.mean(predicted == judged.labels) > 0.82
    assert right.min() > 0.75
