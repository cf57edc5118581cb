"""Checks before a run starts; every mistake is reported in one line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.kinds.names import check_names
from grasptypes.labels.label_sources import check_published
from grasptypes.objects.own_objects import check_every_hold, check_own_objects
from grasptypes.objects.reference_meshes import reference_meshes
from grasptypes.objects.variants import all_objects
from grasptypes.predictors.photograph_folder import photograph_files
from grasptypes.settings.holds import check_tasks, read_hold_table
from grasptypes.settings.params import Params
from grasptypes.settings.tasks import read_tasks
from grasptypes.versions.guard import check_cache_links


def check_start(params: Params, root: str | Path, environment: Mapping[str, str]) -> None:
    """Check the files that the parameters name, and the user's settings.

    Args:
        params: from params.yaml, with changes from the command line.
        root: root folder of the checkout.
        environment: environment variables of the process.

    Raises:
        InputError: the first mistake.
    """
    if set(str(root)) & set("{}"):
        raise InputError(root, "", "Snakemake treats braces as wildcards; move the checkout")
    check_cache_links(root)
    check_tasks(read_tasks(), read_hold_table())
    check_own_objects(params.objects)
    check_names(params.kinds.names)
    check_every_hold(params.objects, {name: read_tasks()[name] for name in params.tasks})
    check_published(environment)
    reference_meshes(environment)
    photograph_files(environment, all_objects(params.objects))
