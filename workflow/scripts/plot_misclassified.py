"""Show for each model which images it names wrong types for."""

from collections.abc import Mapping, Sequence

from grasptypes.jobs import job
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.scoring import PREDICTION_SCHEMA
from grasptypes.reports.misclassified import draw_misclassified
from grasptypes.tables import read_table


def plot_misclassified(
    models: Sequence[tuple[str, str, str, str]], archives: Mapping[str, str]
) -> None:
    """Draw a figure for each model.

    Args:
        models: its name, its predictions, the samples with its labels, and its figure.
        archives: images of each object.
    """
    for name, predictions, samples, target in models:
        answers = read_table(predictions, PREDICTION_SCHEMA)
        figure = draw_misclassified(name, answers, read_samples(samples), archives)
        save_figure(figure, target)


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        samples = dict(zip(params.labels, inputs.samples, strict=True))
        names = [" ".join(name) for name in params.names]
        labelled = [samples[labels] for labels, _ in params.names]
        models = zip(names, inputs.predictions, labelled, snakemake.output.figures, strict=True)
        archives = dict(zip(params.objects, inputs.pictures, strict=True))
        plot_misclassified(list(models), archives)
