"""Test a model that is told one of many tasks; one job per way of telling it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.demonstrations import Demonstrations, read_features, together
from grasptypes.predictors.features import read_inputs
from grasptypes.predictors.folds import FOLD_SCHEMA
from grasptypes.predictors.many_task_tables import TRIAL_SCHEMA
from grasptypes.predictors.many_tasks import ManyTasks, try_model
from grasptypes.predictors.predictor_files import FROZEN
from grasptypes.settings.many_tasks import ManyTaskSettings
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import read_table, write_table


def read_shown(
    usual: Sequence[str | Path],
    further: Sequence[str | Path],
    tasks: Mapping[str, Sequence[str]],
) -> Demonstrations | None:
    """All demonstrations, if there are any; `tasks` are those of each file of further ones."""
    found = [read_features(usual)] if usual else []
    found += [read_features([path], tasks[Path(path).stem]) for path in further]
    return together(found) if found else None


def learn_many_tasks(
    files: Mapping[str, Any],
    target: str | Path,
    model: str,
    further: Mapping[str, Sequence[str]],
    settings: tuple[ManyTaskSettings, PredictorSettings, float],
    seed: int,
) -> None:
    """Write the trials of one model.

    Args:
        files: `inputs`, `shifted`, `samples`, `folds`, `demonstrations`, `further_demonstrations`.
        further: tasks of each object that other results do not have.
        settings: of the study, of training, and the share of examples without a demonstration.
    """
    inputs, shifted = read_inputs(files["inputs"], {}), read_inputs(files["shifted"], {})
    problem = ManyTasks(
        read_samples(files["samples"]),
        read_table(files["folds"], FOLD_SCHEMA),
        {name: {**inputs[name], **shifted.get(name, {})} for name in inputs},
        read_shown(files["demonstrations"], files["further_demonstrations"], further),
        *settings,
        seed,
    )
    table = try_model(problem, model)
    write_table(table[list(TRIAL_SCHEMA.columns)], target, TRIAL_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        learn_many_tasks(
            dict(snakemake.input.items()),
            snakemake.output.metrics,
            snakemake.wildcards.told,
            params.further,
            (
                ManyTaskSettings.check(params.settings),
                PredictorSettings.check(params.predictors | {"finetune": FROZEN}),
                params.missing,
            ),
            params.seed,
        )
