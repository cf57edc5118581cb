"""Show some renders of every object on one sheet."""

from collections.abc import Sequence

from grasptypes.jobs import job
from grasptypes.predictors.features import read_pictures
from grasptypes.reports.result_plots import contact_sheet


def plot_renders(archives: Sequence[str], target: str, views: int, columns: int) -> None:
    """Write a sheet of the first `views` pictures of each archive."""
    contact_sheet({path: read_pictures(path)[:views] for path in archives}, target, columns)


if __name__ == "__main__":
    with job(snakemake.log):
        plot_renders(
            snakemake.input.pictures,
            snakemake.output.sheet,
            snakemake.params.views,
            snakemake.params.columns,
        )
