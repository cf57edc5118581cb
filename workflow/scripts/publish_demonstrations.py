"""Publish the model that is shown the task to MLflow: a run for each label source and split."""

from pathlib import Path

from grasptypes.files import write_json
from grasptypes.jobs import job
from grasptypes.predictors.demonstrations import TRIAL_SCHEMA
from grasptypes.predictors.metrics import METRICS
from grasptypes.runs.demonstration_runs import demonstration_records
from grasptypes.runs.publishing import version_tags
from grasptypes.runs.tracking import Store
from grasptypes.settings.commands import TrackingSettings
from grasptypes.tables import read_table
from grasptypes.versions.provenance import times_ms

if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        tags = {"hand": params.hand} | version_tags({"features": list(map(Path, inputs.features))})
        store, keys = Store(TrackingSettings.model_validate(params.tracking)), {}
        for path in inputs.trials:
            trials = read_table(path, TRIAL_SCHEMA)
            records = demonstration_records(trials, params.settings, times_ms(Path(path)), tags)
            for record in records:
                with store.opened():
                    store.offer_view(METRICS)
                    store.upsert(record)
                keys[record.name] = record.key
        write_json(snakemake.output.runs, keys)
