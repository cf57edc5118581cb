"""Publish the models that are told one of many tasks to MLflow: a run for each number of tasks."""

from pathlib import Path

from grasptypes.files import write_json
from grasptypes.jobs import job
from grasptypes.predictors.many_task_tables import TRIAL_SCHEMA
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.runs.many_task_runs import many_task_records
from grasptypes.runs.publishing import version_tags
from grasptypes.runs.tracking import Store
from grasptypes.settings.commands import TrackingSettings
from grasptypes.tables import read_table
from grasptypes.versions.provenance import times_ms

if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        tags = {"hand": params.hand} | version_tags({"samples": [Path(inputs.samples)]})
        record = BackboneRecord.read(inputs.backbone)
        settings = params.settings | {"backbone": record.backbone, "weights": record.weights}
        store, keys = Store(TrackingSettings.model_validate(params.tracking)), {}
        for path in inputs.trials:
            trials = read_table(path, TRIAL_SCHEMA)
            for one in many_task_records(trials, settings, times_ms(Path(path)), tags):
                with store.opened():
                    store.offer_view(METRICS)
                    store.upsert(one)
                keys[one.name] = one.key
        write_json(snakemake.output.runs, keys)
