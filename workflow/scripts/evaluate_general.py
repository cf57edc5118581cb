"""Answers of the predictor for unseen objects, and of simpler ones, about objects held out."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import torch

from grasptypes.jobs import job
from grasptypes.labels.samples import read_samples
from grasptypes.predictors.general_files import (
    kind_families,
    labelled,
    read_known_kinds,
    read_known_objects,
    read_pictures_of,
    scan_facts,
)
from grasptypes.predictors.general_inputs import FACTS, spread_of
from grasptypes.predictors.general_protocol import (
    ANSWER_SCHEMA,
    OBJECTS,
    PHOTOGRAPHS,
    PHOTOGRAPHS_KNOWN,
    SCANS,
    SCANS_KNOWN,
    hold_out_images,
)
from grasptypes.predictors.general_study import (
    Study,
    Test,
    answer_as_paper,
    answer_by_shape,
    answer_everything,
    first_views,
)
from grasptypes.settings.general import GeneralSettings
from grasptypes.settings.predictors import PredictorSettings
from grasptypes.tables import write_table


def read_study(
    files: Mapping[str, Any],
    named: tuple[Sequence[str], Sequence[str], Mapping[str, tuple[str, float]]],
    settings: GeneralSettings,
) -> Study:
    """Everything that the protocol needs.

    Args:
        files: images of kinds, objects and renders, of scans and photographs if there are any;
            properties and samples.
        named: sources of the samples of objects, in order; tasks; meshes of scans in metres, and
            their scale.
    """
    labels, tasks, meshes = named
    kinds = read_known_kinds(files["kinds"], files["kind_samples"], files["kind_properties"], tasks)
    objects = read_known_objects(
        files["objects"],
        files["simulated"],
        files["properties"],
        settings.protocol.families,
        kinds,
    )
    facts = objects.facts
    samples = {
        source: labelled(read_samples(path), facts.index)
        for source, path in zip(labels, files["samples"], strict=True)
    }
    renders = read_pictures_of(files["renders"])
    shown = first_views(renders, settings.protocol.test_views)
    tests = [Test(OBJECTS, shown, facts, objects.families, held_out=True)]
    if files["scans"]:
        scans, sizes = read_pictures_of(files["scans"]), scan_facts(meshes, facts)
        tests += [
            Test(SCANS_KNOWN, scans, sizes, objects.families, held_out=False),
            Test(SCANS, scans, sizes, objects.families, held_out=True),
        ]
    if files["photographs"]:
        photographs = read_pictures_of(files["photographs"])
        unknown = pd.DataFrame(np.nan, sorted(set(photographs.objects)), list(FACTS))
        others = [name for name in unknown.index if name not in objects.families]
        families = {**objects.families, **kind_families(others)}
        tests += [
            Test(PHOTOGRAPHS_KNOWN, photographs, unknown, families, held_out=False),
            Test(PHOTOGRAPHS, photographs, unknown, families, held_out=True),
        ]
    return Study(kinds, objects, renders, tests, samples)


if __name__ == "__main__":
    with job(snakemake.log) as log:
        torch.set_num_threads(snakemake.threads)
        params = snakemake.params
        settings = GeneralSettings.check(params.settings)
        files, folds = dict(snakemake.input.items()), settings.protocol.folds
        other = spread_of(settings.protocol.size_spread, settings.protocol.mass_spread)
        named = params.labels, params.tasks, params.scans
        study = read_study(files, named, settings)
        of_kinds, of_objects = files["shapes"]
        shapes = {"kinds": of_kinds, "objects": of_objects, "renders": of_objects}
        shapes |= {"scans": files["scan_shapes"], "photographs": []}
        shaped = read_study(files | shapes, named, settings)
        by_shape = settings.head.changed(
            pictures=settings.protocol.shape_directions,
            classes=0,
            memory=settings.head.memory.changed(last_features=0),
        )
        baseline = PredictorSettings.check(params.predictors)
        answers = [
            hold_out_images(study.kinds, settings.head, other, params.seed),
            answer_everything(study, settings.head, folds, params.seed),
            answer_by_shape(shaped, by_shape, folds, params.seed),
            answer_as_paper(study, baseline, params.seed),
        ]
        write_table(pd.concat(answers, ignore_index=True), snakemake.output.answers, ANSWER_SCHEMA)
        log.info("learned from %d kinds' shapes", len(study.kinds.facts))
