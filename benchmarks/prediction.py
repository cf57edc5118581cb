"""What the parts of `grasptypes predict` are worth: `python -m benchmarks.prediction PART`.

Parts: `time`, `objects`, `explanations`, `strange`, `kinds`, `depth`, `confidence`. They need the
files of `snakemake reports/table3.csv`; `objects` and `strange` need GRASPTYPES_PHOTOGRAPHS, too.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import torch
import trimesh
from benchmarks.strange_images import groups
from scipy.special import expit

from grasptypes.kinds.names import shape_of
from grasptypes.labels.samples import LABELS, read_samples
from grasptypes.predictors.explanation import blurred, explain, small
from grasptypes.predictors.families import family_folds
from grasptypes.predictors.general_files import (
    kind_families,
    read_known_kinds,
    read_pictures_of,
)
from grasptypes.predictors.general_inputs import TaskCode
from grasptypes.predictors.general_predictor import GeneralNetwork
from grasptypes.predictors.general_protocol import KINDS, OCCURS, WITH_SIZE
from grasptypes.predictors.known_kinds import nearest
from grasptypes.predictors.memory import Memory
from grasptypes.predictors.photograph_folder import PHOTOGRAPHS
from grasptypes.predictors.prediction import Predictor
from grasptypes.predictors.shown import Shown
from grasptypes.predictors.strangeness import Strangeness
from grasptypes.renders.archives import read_pictures
from grasptypes.renders.depth_images import Intrinsics, longest_extent
from grasptypes.renders.foreground import objects_in
from grasptypes.renders.photos import Box, read_whole
from grasptypes.renders.scene import viewpoints
from grasptypes.seeds import rng
from grasptypes.settings.params import Params, read_params

ROUNDS = 15  # of the timing
SHOWN = 60  # images of each measurement
OUTER = 5  # groups of kinds that are held out, limit and all
DELETED = 0.2  # share of an image that is deleted


def answers_take(params: Params) -> Iterator[str]:
    """Time of an answer, in times of the backbone alone; both take turns."""
    predictor = Predictor.load(params=params, model="general")
    network = predictor.model
    assert isinstance(network, GeneralNetwork)
    for count in (1, 12):
        pictures = rng("time").integers(0, 256, (count, 224, 224, 3), dtype=np.uint8)
        shown = [Shown((picture,)) for picture in pictures]
        jobs: dict[str, Callable[[], object]] = {
            "backbone": lambda pictures=pictures: network.features(pictures),  # type: ignore[misc]
            "answer": lambda shown=shown: predictor.answer(shown, "use"),  # type: ignore[misc]
        }
        taken = {name: [_seconds(job) for _ in range(ROUNDS)] for name, job in jobs.items()}
        middle = {name: float(np.median(times)) for name, times in taken.items()}
        ratio = middle["answer"] / middle["backbone"]
        yield f"{count} images: backbone {middle['backbone']:.3f} s, ratio {ratio:.2f}"


def _seconds(job: Callable[[], object]) -> float:
    start = time.process_time()
    job()
    return time.process_time() - start


def objects_are_counted(params: Params) -> Iterator[str]:
    """How often photographs of one object, of two, and of none are taken for what they are."""
    folder, settings = Path(os.environ[PHOTOGRAPHS]), params.predict.foreground
    table = pd.read_csv(folder / "photographs.csv").iloc[::5]
    room = "one, with the room around it"
    counts: dict[str, list[int]] = {"one": [], room: [], "two": [], "none": []}
    hits = []
    for row in table.to_dict("records"):
        whole = read_whole(folder / row["file"], params.predict.photos)
        box = row["left"], row["top"], row["right"], row["bottom"]
        pad = 40
        left, top = max(box[0] - pad, 0), max(box[1] - pad, 0)
        one = whole[top : box[3] + pad, left : box[2] + pad]
        found = objects_in(one, settings)
        counts["one"].append(-1 if found is None else len(found))
        if found:
            hits.append(_overlap(found[0], tuple(np.subtract(box, (left, top) * 2))))
        seen = objects_in(whole, settings)
        counts[room].append(-1 if seen is None else len(seen))
        two = objects_in(np.hstack([one, one[::-1]]), settings)
        counts["two"].append(-1 if two is None else len(two))
        below = whole[min(box[3] + 20, 400) :, : max(64, whole.shape[1])]
        none = objects_in(below, settings)
        counts["none"].append(-1 if none is None else len(none))
    for name, expected in (("one", 1), (room, 1), ("two", 2), ("none", 0)):
        right, silent = np.mean(np.equal(counts[name], expected)), np.mean(np.less(counts[name], 0))
        yield f"{name}: {right:.2f} right, {silent:.2f} says nothing, of {len(counts[name])}"
    yield f"overlap of the box found and the named one (IoU): {np.median(hits):.2f}"


def _overlap(one: Box, other: Box) -> float:
    """Area of what two boxes share, over that of what they cover."""
    sides = [min(one[k + 2], other[k + 2]) - max(one[k], other[k]) for k in (0, 1)]
    shared = max(sides[0], 0) * max(sides[1], 0)
    areas = [(box[2] - box[0]) * (box[3] - box[1]) for box in (one, other)]
    return float(shared / (sum(areas) - shared))


def explanations_hold(params: Params) -> Iterator[str]:
    """How far the best type's probability falls when marked and random squares are deleted."""
    predictor = Predictor.load(params=params, model="general")
    network, settings = predictor.model, params.predict.explanation
    assert isinstance(network, GeneralNetwork)

    def ask(pictures: object) -> np.ndarray:
        """Logits of the first output."""
        return network.logits(np.stack(pictures), "use")  # type: ignore[call-overload]

    falls = []
    for path in sorted(Path("data/general/pictures").glob("*.zip"))[:: max(1, 301 // SHOWN)]:
        picture = small(read_pictures(path)[0], 224)
        heat = explain(picture, ask, settings)
        best = int(np.argmax(ask([picture])[0]))
        cells = heat[best].reshape(14, 16, 14, 16).mean(axis=(1, 3))
        count = round(DELETED * cells.size)
        random = [rng("delete", path.stem, k).permutation(cells.size)[:count] for k in range(5)]
        chosen = [np.argsort(-cells.ravel())[:count], *random]
        changed = [_without(picture, cell, blurred(picture, settings)) for cell in chosen]
        chances = expit(ask([picture, *changed]))[:, best]
        falls.append([chances[0] - chances[1], chances[0] - chances[2:].mean()])
    marked, random_fall = np.array(falls).T
    error = np.std(marked - random_fall) / np.sqrt(len(falls))
    yield f"{DELETED:.0%} of {len(falls)} images deleted: the best type's probability falls by"
    yield f"{marked.mean():.3f} marked, {random_fall.mean():.3f} random; paired error {error:.3f}"


def _without(picture: np.ndarray, cells: np.ndarray, soft: np.ndarray) -> np.ndarray:
    """The image in which some of 14 x 14 cells are blurred."""
    mask = np.isin(np.arange(14 * 14), cells).reshape(14, 14).repeat(16, 0).repeat(16, 1)
    return np.asarray(np.where(mask[..., None], soft, picture))


def strange_is_found(params: Params) -> Iterator[str]:
    """Images of held-out kinds, scans and photographs that are called strange, and others."""
    kinds = read_pictures_of("data/general/features/kinds.npz")
    families = kind_families(sorted(set(kinds.objects.tolist())))
    alarms = []
    for out in family_folds(families, OUTER, params.seed + 1):
        held = np.array([bool(families[name] & out) for name in kinds.objects])
        kept = {name: own for name, own in families.items() if not own & out}
        known = Strangeness.of(kinds.rows(~held), kept, params.general.strangeness, params.seed)
        alarms += (known(kinds.features[held]) > 1).tolist()
    yield f"kinds held out: {np.mean(alarms):.3f} of {len(alarms)}"
    predictor = Predictor.load(params=params, model="general")
    network = predictor.model
    assert isinstance(network, GeneralNetwork)
    for name in ("renders", "scans", "photographs"):
        path = Path(f"data/general/features/{name}.npz")
        if path.is_file():
            shown = network.strangeness(read_pictures_of(path).features)
            yield f"{name}: {(shown > 1).mean():.3f} of {len(shown)}"
    for name, pictures in groups().items():
        shown = network.strangeness(network.features(pictures))
        yield f"{name}: {(shown > 1).mean():.3f} of {len(shown)}"


def kinds_are_found(params: Params) -> Iterator[str]:
    """How often a kind is among the most similar ones, for views of it that were left out."""
    properties = Path("data/kinds/objects").glob("*/properties.json")
    known = read_known_kinds(
        "data/general/features/kinds.npz", "data/kinds/samples.csv", properties, list(params.tasks)
    )
    kinds, code, first, among = known.pictures, TaskCode.of(known.tasks), [], []
    views = pd.Series(kinds.objects).groupby(kinds.objects).cumcount().to_numpy()
    for view in range(views.max() + 1):
        others = replace(known, pictures=kinds.rows(views != view))
        memory = Memory.of(*others.examples(code), params.general.head.memory)
        for row in np.flatnonzero(views == view):
            near = nearest(memory, kinds.features[[row]], params.predict.known_kinds.shown)
            names = [one.name for one in near]
            own = shape_of(kinds.objects[row])[0]
            first.append(names[0] == own)
            among.append(own in names)
    yield f"views left out: first {np.mean(first):.2f}, among the three {np.mean(among):.2f}"


def depth_measures(params: Params) -> Iterator[str]:
    """The longest extent found in simulated depth images of kinds, over the true one."""
    found = []
    camera = Intrinsics((525.0, 525.0), (319.5, 239.5))
    for path in sorted(Path("data/kinds/objects").glob("*/visual.glb"))[:: 301 // SHOWN]:
        mesh = trimesh.load(path, force="mesh")
        points = np.asarray(trimesh.sample.sample_surface(mesh, 400_000, seed=0)[0])
        pose = viewpoints(points, 1, params.renders, rng("depth", path.parent.name))[0]
        seen = (points - pose[:3, 3]) @ pose[:3, :3]
        away = seen - seen.mean(axis=0) + [0, 0, -0.6]  # cameras look along -z
        depth = _depth_image(away * [1, -1, -1], camera)
        noisy = depth + rng("noise", path.parent.name).normal(0, 0.002, depth.shape)
        region = np.isfinite(depth)
        if region.sum() < 50 or float(mesh.extents.max()) > 0.5:
            continue
        longest_m = longest_extent(noisy, region, camera, params.predict.depth, path)
        found.append(longest_m / float(mesh.extents.max()))
    low, middle, high = np.quantile(found, [0.1, 0.5, 0.9])
    yield f"median {middle:.2f}, 80% within {low:.2f} to {high:.2f}, of {len(found)}"


def _depth_image(points: np.ndarray, camera: Intrinsics) -> np.ndarray:
    """The nearest point of each pixel (480, 640), metres; NaN where there is none."""
    pixels = points[:, :2] / points[:, 2:] * camera.focal + camera.centre
    columns, rows = np.round(pixels).astype(int).T
    inside = (columns >= 0) & (columns < 640) & (rows >= 0) & (rows < 480)
    depth = np.full((480, 640), np.inf)
    np.minimum.at(depth, (rows[inside], columns[inside]), points[inside, 2])
    return np.where(np.isfinite(depth), depth, np.nan)


def confidence_is_right(params: Params) -> Iterator[str]:
    """Expected and actual share of types that are rightly chosen or not, on held-out kinds."""
    told = pd.read_parquet("data/general/answers.parquet")
    told = told[(told["shown"] == KINDS) & (told["model"] == WITH_SIZE)]
    labels = read_samples("data/kinds/samples.csv").set_index(["object", "task"])[list(LABELS)]
    pairs = pd.MultiIndex.from_frame(told[["object", "task"]])
    known = pairs.isin(labels.index)
    chances = told.loc[known, list(OCCURS)].to_numpy()
    right = ((chances > 0.5) == labels.loc[pairs[known]].to_numpy(bool)).mean(axis=1)
    confidence = np.maximum(chances, 1 - chances).mean(axis=1)
    for part in np.array_split(np.argsort(confidence), 4):
        yield f"confidence {confidence[part].mean():.3f}, right {right[part].mean():.3f}"


PARTS = {
    "time": answers_take,
    "objects": objects_are_counted,
    "explanations": explanations_hold,
    "strange": strange_is_found,
    "kinds": kinds_are_found,
    "depth": depth_measures,
    "confidence": confidence_is_right,
}


def main() -> None:
    """Command line."""
    torch.set_num_threads(1)
    params = read_params("params.yaml")
    for part in sys.argv[1:] or PARTS:
        for line in PARTS[part](params):
            sys.stdout.write(f"{part}: {line}\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
