"""Map where people touch an object for a task; one job an object and task."""

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from grasptypes.affinities import holds_of, read_affinities
from grasptypes.contact_map import map_contacts, sample_surface, write_contact_map
from grasptypes.jobs import job
from grasptypes.object_files import read_properties, read_surface
from grasptypes.seeds import seed


def write_map(
    surface: str | Path,
    properties: str | Path,
    affinities: str | Path,
    target: str | Path,
    name: tuple[str, str],
    objects: Collection[str],
    tasks: Collection[str],
    seed_number: int,
    params: Mapping[str, Any],
) -> None:
    """Draw the sessions of `name` (object, task) and write their contact maps to `target`."""
    mesh = read_surface(surface)
    scale = read_properties(properties)["scale"]
    part_names = [str(part) for part in mesh.part_names]
    table = read_affinities(affinities, objects, tasks)
    holds = holds_of(table, *name, part_names, affinities)
    points = sample_surface(
        mesh.vertices,
        mesh.faces,
        mesh.part_index,
        params["points"],
        seed("surface", name[0], seed_number) % 2**31,
    )
    contact_map = map_contacts(points, part_names, holds, name, seed_number, params, scale)
    write_contact_map(contact_map, target)


if __name__ == "__main__":
    with job(snakemake.log):
        write_map(
            snakemake.input.surface,
            snakemake.input.properties,
            snakemake.input.affinities,
            snakemake.output.contact_map,
            (snakemake.wildcards.object, snakemake.wildcards.task),
            snakemake.params.objects,
            snakemake.params.tasks,
            snakemake.params.seed,
            snakemake.params.settings,
        )
