"""The published poses with human labels: their source and their measures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.labels.agreement import PublishedMeasures, measure_published
from grasptypes.labels.published import read_published
from grasptypes.labels.published_objects import object_distances
from grasptypes.labels.published_source import PUBLISHED, published_path
from grasptypes.objects.reference_meshes import REFERENCES
from grasptypes.settings.grasp_types import GraspTypeSettings

SOURCES = {
    PUBLISHED: "get GraspTypesWithTasks.csv from github.com/nikleer/GraspTypesWithTasks, or give "
    "its URL and checksum: https://...#sha256=<64 hex digits>",
    REFERENCES: "get a folder of <object>.stl from github.com/F1sh-Fang/contactdb_assets",
}


def lacking_data(environment: Mapping[str, str]) -> str:
    """Missing data among those named by environment variables, and how to get them.

    Returns:
        One line; empty if nothing is missing.
    """
    places = {PUBLISHED: published_path(environment), REFERENCES: environment.get(REFERENCES)}
    absent = [name for name, place in places.items() if not Path(place or "missing").exists()]
    return "; ".join(
        f"{name}={environment.get(name, '')} names nothing, {SOURCES[name]}" for name in absent
    )


def read_measures(
    environment: Mapping[str, str], own: str | Path, scale: float, settings: GraspTypeSettings
) -> PublishedMeasures:
    """Measure all published poses that have a type, a configuration and an object mesh.

    Args:
        environment: names the published table, by path or URL, and the folder of reference meshes.
        own: folder of prepared objects, for those without a reference mesh.
        scale: scale of the reference meshes.
    """
    path = published_path(environment)
    published = read_published(path)
    if published.hand_configuration.isna().all():
        raise InputError(path, "", "has no grasp with a hand configuration")
    names = sorted(published.object.unique())
    references = environment[REFERENCES]
    fields = object_distances(names, references, own, scale, settings.own_frames)
    return measure_published(published, fields, settings.contacts)
