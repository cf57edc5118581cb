"""Compare the grasp-type counts with the published ones."""

from pathlib import Path

from grasptypes.jobs import job
from grasptypes.labels.grasp_type import TYPES
from grasptypes.labels.label_pictures import draw_distribution, save_figure
from grasptypes.labels.samples import COUNT_SCHEMA, read_samples
from grasptypes.reports.distribution import DISTRIBUTION_SCHEMA, compare_distributions, describe
from grasptypes.tables import read_table, write_table


def compare(samples_file: Path, published_file: Path, table: Path, figure: Path) -> str:
    """Write the comparison and its figure; returns a line to log."""
    samples = read_samples(samples_file)
    published = read_table(published_file, COUNT_SCHEMA)
    compared = compare_distributions(samples, published, published_file)
    write_table(compared, table, DISTRIBUTION_SCHEMA)
    types, differ = describe(samples)
    line = (
        f"angular similarity {compared.similarity.iloc[-1]:.3f}; {types:.2f} types a sample, "
        f"{differ:.2f} differ between tasks"
    )
    save_figure(draw_distribution(compared.iloc[:-1], TYPES, line), figure)
    return line


if __name__ == "__main__":
    with job(snakemake.log) as log:
        log.info(
            compare(
                Path(snakemake.input.samples),
                Path(snakemake.input.published),
                Path(snakemake.output.table),
                Path(snakemake.output.figure),
            )
        )
