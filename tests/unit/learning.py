"""A small learning problem with an answer, and small predictors that only look trained."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import torch
import yaml
from tests.unit.settings import PARAMS, RAW

from grasptypes.labels.samples import COUNTS, TYPES, samples_from_counts
from grasptypes.predictors.backbone import KINDS, untrained_backbone
from grasptypes.predictors.examples import Examples, assemble
from grasptypes.predictors.folds import split
from grasptypes.predictors.predictor import Architecture, BatchedMLP
from grasptypes.predictors.predictor_files import ModelCard, write_predictor
from grasptypes.predictors.variants import VARIANTS
from grasptypes.predictors.weights import Weights, weights_file
from grasptypes.settings.predictors import NO_TASK, FineTuning
from grasptypes.yaml_files import merge

ROOT = Path(__file__).parents[2]
SHIFTS = {"use": 10, "handoff": -10, "wash": 20}
TASKS = {"use": 10, "handoff": -10, "show": 0}
OBJECTS = ("apple", "mug", "pan", "knife")
VIEWS = 20
SETTINGS = PARAMS.predictors.changed(
    hidden=(32, 24, 16),
    components=12,
    epochs=80,
    batch=32,
    weight_decay=0.01,
    dropout=0.0,
    finetuning=FineTuning(last_blocks=1, learning_rate=1e-4, epochs=2, batch=8),
)
# A checkout whose plans take seconds.
SMALL_PLANS = {
    "renders": {"size_px": 96},
    "predict": {"views": 2},
    "gallery": {"size_px": 64, "tile_px": 64},
    "synthesis": {"candidates": {"number": 150}, "refinement": {"rounds": 1}},
    "physics": {"test": {"shake": False, "squeeze_time_s": 0.3, "hold_time_s": 0.1}},
    "contact_maps": {"points": 1500},
    "objects": {"resolution": {"surface_edge_m": 0.006, "grid_spacing_m": 0.004}},
    "plan": {"sessions": 3, "shown": 2},
}


def samples() -> pd.DataFrame:
    """Labels of which every (object, task) has another, two or three types each."""
    rows = []
    for i, name in enumerate(OBJECTS):
        for j, task in enumerate(TASKS):
            counts = np.zeros(6, dtype=int)
            counts[[i, (i + 1 + j) % 6, 5 if j == 2 else i]] = 1 + j
            rows.append({"object": name, "task": task, **dict(zip(COUNTS, counts, strict=True))})
    return samples_from_counts(pd.DataFrame(rows))


def folds() -> pd.DataFrame:
    """Four folds over 20 views an object."""
    return split(dict.fromkeys(OBJECTS, VIEWS), 4, seed=0)


def features() -> dict[str, dict[str, np.ndarray]]:
    """Object to encoding to (20, 24): a direction an object and one a task, with noise."""
    rng = np.random.default_rng(0)
    out = {}
    for i, name in enumerate(OBJECTS):
        base = rng.normal(scale=0.1, size=(VIEWS, 24)) + 2 * np.eye(24)[i]
        shifts = {NO_TASK: 0 * base[0]} | {t: np.eye(24)[10 + j] for j, t in enumerate(TASKS)}
        out[name] = {e: (base + shift).astype(np.float32) for e, shift in shifts.items()}
    return out


def examples(model: str) -> Examples:
    """The problem as a variant sees it."""
    return assemble(VARIANTS[model], features(), samples(), folds(), list(TASKS))


def random_weights(path: Path) -> Weights:
    """A weights file for MobileNetV2 with drawn, not learned, numbers."""
    torch.manual_seed(0)
    stem = untrained_backbone("mobilenet_v2", 32).blocks.state_dict()
    state = {f"features.{name}": tensor for name, tensor in stem.items()}
    state["classifier.1.weight"] = torch.zeros(1000, 1280)
    state["classifier.1.bias"] = torch.zeros(1000)
    torch.save(state, path)
    return weights_file("mobilenet_v2", "test", path)


def small_predictor(folder: Path, weights: Weights, model: str = "task_vector") -> None:
    """Write tensors and card of a predictor of drawn numbers for three tasks; answers differ."""
    tasks = len(SHIFTS) if VARIANTS[model].task_vector else 0
    sizes = Architecture(KINDS["mobilenet_v2"].features, tasks, (8, 8, 8), 6)
    card = ModelCard(
        **{"model": model, "labels": "simulated", "types": TYPES, "tasks": tuple(SHIFTS)},
        **{"colour_shifts": SHIFTS, "architecture": sizes, "finetune": "none"},
        **{"backbone": weights.backbone, "weights": weights.name, "input_px": 32},
    )
    heads = BatchedMLP(sizes, [("a",)])
    with torch.no_grad():
        heads.weights[-1] *= 30
    files = folder / "predictor.safetensors", folder / "predictor.json"
    write_predictor(heads, None, card, *files)


def small_checkout(root: Path, changes: dict) -> Weights:
    """Make a folder with changed parameters and two models of random weights, `random.pth`."""
    weights = random_weights(root / "random.pth")
    for model in ("task_vector", "no_task"):
        small_predictor(root / "models/simulated" / model, weights, model)
    params = merge(RAW, changes)
    (root / "params.yaml").write_text(yaml.safe_dump(params, sort_keys=False))
    return weights
