"""Checks before a run starts; every mistake is reported in one line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.contact_maps.affinities import AffinityRow, read_affinities
from grasptypes.errors import InputError
from grasptypes.labels.label_sources import check_published
from grasptypes.objects.own_objects import check_every_hold, check_own_objects
from grasptypes.objects.reference_meshes import reference_meshes
from grasptypes.settings.objects import CATALOGUE
from grasptypes.settings.params import Params
from grasptypes.versions.guard import check_cache_links


def check_start(
    params: Params, root: str | Path, environment: Mapping[str, str]
) -> dict[tuple[str, str], tuple[AffinityRow, ...]]:
    """Check the files that the parameters name, and the user's settings.

    Args:
        params: from params.yaml, with changes from the command line.
        root: root folder of the checkout.
        environment: environment variables of the process.

    Returns:
        the rows of the affinity table for each object and task.

    Raises:
        InputError: the first mistake.
    """
    if set(str(root)) & set("{}"):
        raise InputError(root, "", "Snakemake treats braces as wildcards; move the checkout")
    check_cache_links(root)
    objects, tasks, table = params.objects, list(params.tasks), params.contact_maps.affinities
    check_own_objects(objects)
    holds = read_affinities(table, [*CATALOGUE, *objects.own], tasks)
    check_every_hold(objects, tasks, holds, table)
    check_published(environment)
    reference_meshes(environment)
    return holds
