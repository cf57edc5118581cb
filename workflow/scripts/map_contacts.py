"""Map where people touch an object for a task; one job an object and task."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from grasptypes.affinities import Hold, check_holds
from grasptypes.contact_map import map_contacts, sample_surface, write_contact_map
from grasptypes.jobs import job
from grasptypes.object_files import read_properties, read_surface
from grasptypes.seeds import seed


def write_map(
    surface: str | Path,
    properties: str | Path,
    target: str | Path,
    name: tuple[str, str],
    holds: Sequence[Hold],
    seed_number: int,
    params: Mapping[str, Any],
) -> None:
    """Draw the sessions of `name` (object, task) and write their contact maps to `target`."""
    mesh = read_surface(surface)
    scale = read_properties(properties)["scale"]
    part_names = [str(part) for part in mesh.part_names]
    check_holds(holds, name, part_names, params["affinities"])
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
            snakemake.output.contact_map,
            (snakemake.wildcards.object, snakemake.wildcards.task),
            snakemake.params.holds,
            snakemake.params.seed,
            snakemake.params.settings,
        )
