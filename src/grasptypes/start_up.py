"""What a run checks before anything starts; every mistake is one line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.contact_maps.affinities import Hold, read_affinities
from grasptypes.labels.published_source import check_published
from grasptypes.objects.own_objects import check_every_hold, check_own_objects
from grasptypes.objects.reference_meshes import reference_meshes
from grasptypes.objects.variants import check_variation
from grasptypes.params import validate_params
from grasptypes.predictors.own_tasks import check_tasks
from grasptypes.versions.guard import check_cache_links


def check_start(
    params: Mapping[str, Any],
    schema: Mapping[str, Any],
    root: str | Path,
    environment: Mapping[str, str],
) -> dict[tuple[str, str], tuple[Hold, ...]]:
    """Check the parameters, the files they name, and the user's settings.

    Args:
        params: content of params.yaml, with what the command line changes.
        schema: content of workflow/schemas/params.schema.yaml.
        root: of the checkout.
        environment: variables of the process.

    Returns:
        the affinity table's rows of each object and task.

    Raises:
        InputError: the first mistake.
    """
    check_cache_links(root)
    validate_params(params, schema)
    objects, tasks = params["objects"], list(params["tasks"])
    check_tasks(params["tasks"])
    check_variation(objects)
    check_own_objects(objects, tasks)
    table = params["contact_maps"]["affinities"]
    catalogue = schema["properties"]["objects"]["properties"]["names"]["items"]["enum"]
    holds = read_affinities(table, [*catalogue, *objects["own"]], tasks)
    check_every_hold(objects, tasks, holds, table)
    check_published(environment)
    reference_meshes(environment)
    return holds
