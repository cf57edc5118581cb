"""Files of the predictor for unseen objects: images in numbers, and what is known of objects."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import trimesh

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz
from grasptypes.kinds.library import read_kind
from grasptypes.kinds.names import shape_of
from grasptypes.labels.samples import read_samples
from grasptypes.objects.object_files import Properties, read_properties
from grasptypes.predictors.general_examples import Known
from grasptypes.predictors.general_inputs import FACTS, SIZE, Pictures
from grasptypes.settings.tasks import read_tasks


def write_pictures(path: str | Path, pictures: Pictures) -> None:
    """Write images in numbers."""
    arrays = {name: np.asarray(array) for name, array in vars(pictures).items()}
    write_npz(path, arrays | {"objects": pictures.objects.astype(np.str_)})


def read_pictures_of(path: str | Path) -> Pictures:
    """Read what :func:`write_pictures` wrote; raises InputError if an array is missing."""
    arrays = read_npz(path)
    try:
        return Pictures(arrays["objects"], arrays["features"], arrays["classes"])
    except KeyError as error:
        raise InputError(path, str(error.args[0]), "this array is missing") from error


def kind_families(shapes: Iterable[str]) -> dict[str, frozenset[str]]:
    """The family of each shape of a kind."""
    return {name: frozenset([read_kind(shape_of(name)[0]).family]) for name in shapes}


def object_families(
    objects: Sequence[str], families: Mapping[str, Sequence[str]]
) -> dict[str, frozenset[str]]:
    """The families of each object; one that has none is a family of its own."""
    return {name: frozenset(families.get(name, [name])) for name in objects}


def read_known_kinds(
    pictures: str | Path,
    samples: str | Path,
    properties: Iterable[str | Path],
    tasks: Sequence[str],
) -> Known:
    """The kinds that have a label, with their images, sizes and families."""
    table = read_samples(samples)
    shapes = sorted(set(table["object"]))
    return Known(
        read_pictures_of(pictures).of(shapes),
        object_facts(properties).loc[shapes],
        table,
        kind_families(shapes),
        {name: read_tasks()[name] for name in tasks},
    )


def read_known_objects(
    pictures: str | Path,
    samples: str | Path,
    properties: Iterable[str | Path],
    families: Mapping[str, Sequence[str]],
    kinds: Known,
) -> Known:
    """The objects of the dataset, with their images, sizes and families, and the kinds' tasks."""
    facts = object_facts(properties)
    return Known(
        read_pictures_of(pictures),
        facts,
        labelled(read_samples(samples), facts.index),
        object_families(list(facts.index), families),
        kinds.tasks,
    )


def object_facts(paths: Iterable[str | Path]) -> pd.DataFrame:
    """Size and mass of prepared objects: a row per object, the columns of :data:`FACTS`.

    Args:
        paths: files of properties.
    """
    known = [read_properties(path) for path in paths]
    rows = {one.object: _facts_of(one) for one in known}
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(FACTS))


def _facts_of(known: Properties) -> list[float]:
    """The logarithms of the three extents, largest first (m), and of the mass (kg)."""
    low, high = np.array(known.bounds_m)
    return [*np.log(np.sort(high - low)[::-1]), float(np.log(known.mass_kg))]


def scan_facts(scans: Mapping[str, tuple[str, float]], facts: pd.DataFrame) -> pd.DataFrame:
    """Sizes of scans as measured on their meshes, and masses as of our models.

    Args:
        scans: files of meshes in metres, and the scale of our models, by the name of the object.
        facts: of our models, see :func:`object_facts`.
    """
    found = facts.loc[list(scans)].copy()
    for name, (path, scale) in scans.items():
        extents_m = scale * trimesh.load_mesh(path).extents
        found.loc[name, list(SIZE)] = np.log(np.sort(extents_m)[::-1])
    return found


def labelled(samples: pd.DataFrame, names: Iterable[str]) -> pd.DataFrame:
    """The samples of some objects."""
    return samples[samples["object"].isin(list(names))].reset_index(drop=True)
