"""What bfloat16 features cost and change: pictures a second, and Table I beside float32's.

python benchmarks/feature_precision.py, after `snakemake renders` and with labels published.
"""

import argparse
import time
from pathlib import Path

import pandas as pd
import torch

from grasptypes.labels.samples import samples_from_counts
from grasptypes.params import read_yaml
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.examples import assemble
from grasptypes.predictors.features import encodings, extract, read_pictures
from grasptypes.predictors.folds import split
from grasptypes.predictors.metrics import METRICS
from grasptypes.predictors.predictor import VARIANTS
from grasptypes.predictors.protocol import recipe_of, try_splits
from grasptypes.predictors.training import members_by_group
from grasptypes.predictors.weights import find_weights


def main() -> None:
    """Write pictures a second and the three measures of every model, both precisions."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--renders", type=Path, default=Path("data/renders"))
    parser.add_argument("--labels", type=Path, default=Path("assets/published_labels.csv"))
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    torch.set_num_threads(options.threads)
    params = read_yaml("params.yaml")
    pictures = {path.stem: read_pictures(path) for path in sorted(options.renders.glob("*.zip"))}
    folds = split(
        {n: len(p) for n, p in pictures.items()}, params["folds"]["count"], params["seed"]
    )
    samples = samples_from_counts(pd.read_csv(options.labels))
    backbone = load_backbone(find_weights(0), params["backbone"]["input_px"])
    rows = {}
    for precision in ("fp32", "bf16"):
        begun = time.perf_counter()
        shifts, batch = encodings(params["tasks"]), params["features"]["batch"]
        inputs = {n: extract(backbone, p, shifts, precision, batch) for n, p in pictures.items()}
        count = len(folds) * len(shifts)
        print(f"{precision}: {count / (time.perf_counter() - begun):.0f} pictures/s", flush=True)  # noqa: T201
        for model, variant in VARIANTS.items():
            examples = assemble(variant, inputs, samples, folds, list(params["tasks"]))
            members = members_by_group(examples.index["fold"], params["predictors"]["seeds"])
            recipe = recipe_of(params["predictors"])
            outcome = try_splits(examples, members, recipe, ("predictor", model, params["seed"]))
            rows[model, precision] = outcome.metrics[list(METRICS)].mean()
    table = pd.DataFrame(rows).T.round(4)
    print(table.to_string())  # noqa: T201
    change = (table.xs("bf16", level=1) - table.xs("fp32", level=1)).abs().max().max()
    print(f"largest change {change:.4f}")  # noqa: T201


if __name__ == "__main__":
    main()
