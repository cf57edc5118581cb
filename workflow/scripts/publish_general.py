"""Publish Table III to MLflow: a run of the predictor for unseen objects, with its folds below."""

from pathlib import Path

from grasptypes.files import write_json
from grasptypes.jobs import job
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.general_files import kind_families
from grasptypes.predictors.general_protocol import ANSWER_SCHEMA
from grasptypes.predictors.metrics import METRICS
from grasptypes.reports.table3 import TABLE_SCHEMA
from grasptypes.runs.general_runs import general_record
from grasptypes.runs.publishing import version_tags
from grasptypes.runs.tracking import Store
from grasptypes.settings.commands import TrackingSettings
from grasptypes.settings.general import GeneralSettings
from grasptypes.tables import read_table
from grasptypes.versions.provenance import times_ms

if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        samples = read_samples(inputs.samples)
        record = general_record(
            read_table(inputs.answers, ANSWER_SCHEMA),
            samples,
            read_table(inputs.table, TABLE_SCHEMA),
            kind_families(sorted(set(samples["object"]))),
            (GeneralSettings.check(params.settings), params.seed),
            times_ms(Path(inputs.answers)),
            {"hand": params.hand} | version_tags({"samples": [Path(inputs.samples)]}),
        )
        store = Store(TrackingSettings.model_validate(params.tracking))
        with store.opened():
            store.offer_view(METRICS)
            store.upsert(record)
        write_json(snakemake.output.runs, {record.name: record.key})
