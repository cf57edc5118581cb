"""Put the plans of all scans into one table, with what parts gain."""

import pandas as pd

from grasptypes.jobs import job
from grasptypes.planning.part_plans import GAIN_SCHEMA, PART_PLAN_SCHEMA, summary
from grasptypes.tables import read_table, write_table

if __name__ == "__main__":
    with job(snakemake.log):
        tables = [read_table(path, PART_PLAN_SCHEMA) for path in snakemake.input.tables]
        table = pd.concat(tables, ignore_index=True)
        write_table(table, snakemake.output.table, PART_PLAN_SCHEMA)
        write_table(summary(table), snakemake.output.summary, GAIN_SCHEMA)
