"""Draw the training and test losses of all models."""

from collections.abc import Mapping

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.predictors.scoring import CURVE_SCHEMA
from grasptypes.reports.training_figures import draw_losses
from grasptypes.tables import read_table


def plot_losses(curves: Mapping[tuple[str, str], str], target: str) -> None:
    """Draw the curves in the files, by labels and model."""
    save_figure(
        draw_losses({name: read_table(path, CURVE_SCHEMA) for name, path in curves.items()}), target
    )


if __name__ == "__main__":
    with job(snakemake.log):
        names = [tuple(name) for name in snakemake.params.names]
        plot_losses(dict(zip(names, snakemake.input.curves, strict=True)), snakemake.output.figure)
