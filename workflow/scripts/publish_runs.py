"""Publish the trained models to MLflow, and record the published runs."""

from pathlib import Path

from grasptypes.files import write_json
from grasptypes.jobs import job
from grasptypes.runs.publishing import publish
from grasptypes.runs.tracking import Store, TrainedModel
from grasptypes.settings.commands import TrackingSettings
from grasptypes.versions.provenance import times_ms

if __name__ == "__main__":
    with job(snakemake.log):
        inputs = {
            name: [Path(file) for file in ([files] if isinstance(files, str) else files)]
            for name, files in snakemake.input.items()
        }
        files = [inputs.pop(name) for name in ("metrics", "curves", "tensors", "cards")]
        figures, own = inputs.pop("figures"), inputs.pop("misclassified")
        models = [
            TrainedModel(*parts, times_ms(parts[-1]), hand, (figure,))
            for *parts, figure, hand in zip(*files, own, snakemake.params.hands, strict=True)
        ]
        store = Store(TrackingSettings.model_validate(snakemake.params.tracking))
        keys = publish(models, snakemake.params.predictors, inputs, store, figures)
        write_json(snakemake.output.runs, keys)
