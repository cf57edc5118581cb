"""Tabulate the grasps of all kinds: by kind, and by role and size."""

from pathlib import Path

from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.kinds.names import kind_names
from grasptypes.labels.dataset import dataset_schema
from grasptypes.reports.kind_statistics import KIND_TABLE, ROLE_TABLE, grasp_roles, kind_tables
from grasptypes.tables import read_table, write_table

if __name__ == "__main__":
    with job(snakemake.log) as log:
        inputs, outputs = snakemake.input, snakemake.output
        dataset = read_table(
            inputs.dataset, dataset_schema(load_hand(snakemake.params.hand["name"]))
        )
        folders = {Path(path).parent.name: Path(path).parent for path in inputs.surfaces}
        kinds, roles = kind_tables(dataset, grasp_roles(inputs.grasps, folders), kind_names())
        write_table(kinds, outputs.kinds, KIND_TABLE)
        write_table(roles, outputs.roles, ROLE_TABLE)
        for row in kinds[kinds.valid == 0].itertuples():
            log.info("nothing holds: %s for %s", row.kind, row.task)
