"""Compare the ranges of kinds with the sizes and masses of real objects."""

from pathlib import Path

from grasptypes.jobs import job
from grasptypes.reports.kind_sizes import SIZE_TABLE, furniture_objects, size_table, ycb_objects
from grasptypes.tables import write_table

if __name__ == "__main__":
    with job(snakemake.log) as log:
        ycb, furniture = (Path(snakemake.params.folders[name]) for name in ("ycb", "furniture"))
        table = size_table(ycb_objects(ycb), furniture_objects(furniture))
        write_table(table, snakemake.output.table, SIZE_TABLE)
        log.info("%d of %d objects are inside their ranges", table.inside.sum(), len(table))
