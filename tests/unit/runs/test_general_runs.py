"""Table III in MLflow: a run with its rows, and the groups of held-out kinds below it."""

import pandas as pd
import pytest
from tests.unit.settings import PARAMS

from grasptypes.labels.samples import COUNTS, TYPES, samples_from_counts
from grasptypes.predictors.general_protocol import (
    ANSWER_SCHEMA,
    CONSTANT,
    DIRECTION,
    KINDS,
    OCCURS,
    SHARES,
    WITH_SIZE,
)
from grasptypes.predictors.metrics import METRICS
from grasptypes.reports.table3 import tabulate
from grasptypes.runs.general_runs import general_record
from grasptypes.runs.tracking import KEY_TAG, Store
from grasptypes.settings.commands import TrackingSettings

NAMES = ["bead", "rope", "vase"]
FAMILIES = {name: frozenset([name]) for name in NAMES}


@pytest.fixture
def record():
    """Answers that are right for one object of three."""
    counts = [
        {"object": name, "task": "use", **dict.fromkeys(COUNTS, 0), COUNTS[number]: 20}
        for number, name in enumerate(NAMES)
    ]
    samples = samples_from_counts(pd.DataFrame(counts))
    numbers = [float(place == 0) for place in range(len(TYPES))]
    rows = [
        {"shown": KINDS, "model": model, "labels": "simulated", "object": name, "task": "use"}
        | {"view": 0}
        | {
            key: numbers[place]
            for names in (OCCURS, DIRECTION, SHARES)
            for place, key in enumerate(names)
        }
        for model in (CONSTANT, WITH_SIZE)
        for name in NAMES
    ]
    answers = ANSWER_SCHEMA.validate(pd.DataFrame(rows))
    table = tabulate(answers, {"simulated": samples}, [], 10)
    settings = PARAMS.general.changed(protocol=PARAMS.general.protocol.changed(folds=3))
    return general_record(
        answers, samples, table, FAMILIES, (settings, 0), (1000, 2000), {"hand": "barrett"}
    )


def test_the_store_has_a_parent_and_a_run_per_fold(record, tmp_path):
    store = Store(
        TrackingSettings(database=f"{tmp_path}/mlflow.db", experiment="test", patience_s=60)
    )
    with store.opened():
        parent = store.upsert(record)
        assert store.upsert(record) == parent
        runs = store._client.search_runs([store._experiment])
    assert len(runs) == 1 + 3
    folds = [run for run in runs if run.data.tags.get("mlflow.parentRunId") == parent]
    found = {run.data.params["families"]: run.data.metrics[METRICS[0]] for run in folds}
    assert found == pytest.approx({"bead": 1, "rope": 0, "vase": 0}, abs=1e-6)
    whole = next(run for run in runs if run.data.tags[KEY_TAG] == record.key)
    assert whole.data.metrics[METRICS[0]] == pytest.approx(1 / 3)
    assert whole.data.metrics["kinds.simulated.general_size.similarity"] == pytest.approx(
        1 / 3, abs=1e-6
    )
