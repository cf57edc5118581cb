"""What bfloat16 features change: Table I beside float32's; takes some minutes.

``python -m benchmarks.precision``, after ``snakemake renders``.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from grasptypes.labels.samples import samples_from_counts
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.features import encodings, extract, read_pictures
from grasptypes.predictors.folds import split
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.protocol import recipe_of, try_splits
from grasptypes.predictors.training import members_by_group
from grasptypes.predictors.weights import find_weights
from grasptypes.yaml_files import read_yaml

RENDERS, LABELS = Path("data/renders"), Path("assets/published_labels.csv")
PRECISIONS = ("fp32", "bf16")


def measures(
    precision: str, pictures: Mapping[str, np.ndarray], params: Mapping[str, Any]
) -> Iterator[tuple[str, pd.Series]]:
    """Each model's three measures with the published labels, mean over folds and seeds."""
    backbone = load_backbone(find_weights(0), params["backbone"]["input_px"])
    shifts, batch = encodings(params["tasks"]), params["features"]["batch"]
    inputs = {n: extract(backbone, p, shifts, precision, batch) for n, p in pictures.items()}
    views = {name: len(shown) for name, shown in pictures.items()}
    folds = split(views, params["folds"]["count"], params["seed"])
    samples, recipe = samples_from_counts(pd.read_csv(LABELS)), recipe_of(params["predictors"])
    for model, variant in VARIANTS.items():
        examples = assemble(variant, inputs, samples, folds, list(params["tasks"]))
        members = members_by_group(examples.index["fold"], params["predictors"]["seeds"])
        outcome = try_splits(examples, members, recipe, ("predictor", model, params["seed"]))
        yield model, outcome.metrics[list(METRICS)].mean()


def main() -> None:
    """Write the three measures of every model with both precisions, and the largest change."""
    params = read_yaml("params.yaml")
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
