"""Turn the published counts of grasp types into samples."""

from collections.abc import Collection
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.labels.samples import COUNT_SCHEMA, SAMPLE_SCHEMA, samples_from_counts
from grasptypes.tables import read_table, write_table


def label_published(
    counts: str | Path, target: str | Path, objects: Collection[str], tasks: Collection[str]
) -> None:
    """Write the samples of the given objects and tasks."""
    table = read_table(counts, COUNT_SCHEMA)
    missing = sorted(set(objects) - set(table["object"]))
    if missing:
        raise InputError(
            counts,
            missing[0],
            "has no published labels; leave 'published' out of params.yaml: labels",
        )
    chosen = table[table["object"].isin(objects) & table["task"].isin(tasks)]
    write_table(samples_from_counts(chosen, counts), target, SAMPLE_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        label_published(
            snakemake.input.counts,
            snakemake.output.samples,
            snakemake.params.objects,
            snakemake.params.tasks,
        )
