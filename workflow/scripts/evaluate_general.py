"""Answers of the predictor for unseen objects, and of simpler ones, about objects held out."""

from collections.abc import Mapping, Sequence
from typing import Any

import torch

from grasptypes.jobs import job
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.general_examples import Known
from grasptypes.predictors.general_files import (
    kind_families,
    labelled,
    object_families,
    read_pictures_of,
)
from grasptypes.predictors.general_inputs import Pictures, object_facts
from grasptypes.predictors.general_protocol import ANSWER_SCHEMA
from grasptypes.predictors.general_study import Study, answer_everything
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.settings.tasks import read_tasks
from grasptypes.tables import write_table


def read_study(
    files: Mapping[str, Any], labels: Sequence[str], tasks: Sequence[str], settings: GeneralSettings
) -> Study:
    """Everything that the protocol needs.

    Args:
        files: images of kinds, objects, renders and scans (none or one); properties and samples.
        labels: sources of the samples of objects, in order.
    """
    known = {name: read_tasks()[name] for name in tasks}
    kind_samples = read_samples(files["kind_samples"])
    shapes = sorted(set(kind_samples["object"]))
    kinds = Known(
        read_pictures_of(files["kinds"]).of(shapes),
        object_facts(files["kind_properties"]).loc[shapes],
        kind_samples,
        kind_families(shapes),
        known,
    )
    facts = object_facts(files["properties"])
    samples = {
        source: labelled(read_samples(path), facts.index)
        for source, path in zip(labels, files["samples"], strict=True)
    }
    objects = Known(
        read_pictures_of(files["objects"]),
        facts,
        labelled(read_samples(files["simulated"]), facts.index),
        object_families(list(facts.index), settings.protocol.families),
        known,
    )
    renders = read_pictures_of(files["renders"])
    scans = [read_pictures_of(path) for path in files["scans"]]
    nothing = Pictures(renders.objects[:0], renders.features[:0], renders.classes[:0])
    return Study(kinds, objects, renders, *(scans or [nothing]), samples)


if __name__ == "__main__":
    with job(snakemake.log) as log:
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        settings = GeneralSettings.check(params.settings)
        study = read_study(dict(snakemake.input.items()), params.labels, params.tasks, settings)
        baseline = PredictorSettings.check(params.predictors)
        answers = answer_everything(study, settings, baseline, params.seed)
        write_table(answers, snakemake.output.answers, ANSWER_SCHEMA)
        log.info("learned from %d kinds' shapes", len(study.kinds.facts))
