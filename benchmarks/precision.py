"""Effect of bfloat16 features on Table I, compared with float32; takes some minutes.

``python -m benchmarks.precision``, after ``snakemake renders``.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from grasptypes.labels.samples import samples_from_counts
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.features import encodings, extract, read_pictures
from grasptypes.predictors.folds import split
from grasptypes.predictors.members import members_by_group
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.protocol import try_splits
from grasptypes.predictors.weights import find_weights
from grasptypes.settings.params import Params, read_params

RENDERS, LABELS = Path("data/renders"), Path("assets/published_labels.csv")
PRECISIONS = ("fp32", "bf16")


def measures(
    precision: str, pictures: Mapping[str, np.ndarray], params: Params
) -> Iterator[tuple[str, pd.Series]]:
    """Each model's three measures with the published labels, mean over folds and seeds."""
    backbone = load_backbone(find_weights(0), params.backbone.input_px)
    shifts, batch = encodings(params.colour_shifts), params.features.batch
    inputs = {n: extract(backbone, p, shifts, precision, batch) for n, p in pictures.items()}
    views = {name: len(shown) for name, shown in pictures.items()}
    folds = split(views, params.folds.count, params.seed)
    samples = samples_from_counts(pd.read_csv(LABELS))
    for model, variant in VARIANTS.items():
        examples = assemble(variant, inputs, samples, folds, list(params.tasks))
        members = members_by_group(examples.index["fold"], params.predictors.seeds)
        outcome = try_splits(
            examples, members, params.predictors, ("predictor", model, params.seed)
        )
        yield model, outcome.metrics[list(METRICS)].mean()


def main() -> None:
    """Write the three measures of every model with both precisions, and the largest change."""
    params = read_params("params.yaml")
    pictures = {path.stem: read_pictures(path) for path in sorted(RENDERS.glob("*.zip"))}
    rows = {
        (model, precision): row
        for precision in PRECISIONS
        for model, row in measures(precision, pictures, params)
    }
    table = pd.DataFrame(rows).T
    change = (table.xs("bf16", level=1) - table.xs("fp32", level=1)).abs().max().max()
    sys.stdout.write(f"{table.round(4).to_string()}\nlargest change {change:.4f}\n")


if __name__ == "__main__":
    main()
