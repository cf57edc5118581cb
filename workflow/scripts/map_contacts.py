"""Map where people touch an object for a task; one job an object and task."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.contact_maps.affinities import check_holds
from grasptypes.contact_maps.contact_map import map_contacts, sample_surface
from grasptypes.contact_maps.contact_map_files import write_contact_map
from grasptypes.contact_maps.measured_contacts import map_measured_contacts, read_probability
from grasptypes.jobs import job
from grasptypes.objects.object_files import read_properties, read_surface
from grasptypes.objects.units import UNITS_M
from grasptypes.seeds import seed


def write_map(
    inputs: Mapping[str, Any],
    target: str | Path,
    name: tuple[str, str],
    seed_number: int,
    params: Mapping[str, Any],
) -> None:
    """Draw the sessions of `name` (object, task) and write their contact maps to `target`.

    Args:
        inputs: surface and properties of the object, and a measured map if there is one.
        params: the section `contact_maps`, with the `holds` of the affinity table or the length
            `unit` of the measured map.
    """
    mesh = read_surface(inputs["surface"])
    scale = read_properties(inputs["properties"])["scale"]
    part_names = [str(part) for part in mesh.part_names]
    surface_seed = seed("surface", name[0], seed_number) % 2**31
    points = sample_surface(
        mesh.vertices, mesh.faces, mesh.part_index, params["points"], surface_seed
    )
    drawn = (name, seed_number, params, scale)
    if inputs["measured"]:
        path = inputs["measured"]
        probability = read_probability(path, scale * UNITS_M[params["unit"]], points, params)
        contact_map = map_measured_contacts(points, part_names, probability, *drawn, path)
    else:
        check_holds(params["holds"], name, part_names, params["affinities"])
        contact_map = map_contacts(points, part_names, params["holds"], *drawn)
    write_contact_map(contact_map, target)


if __name__ == "__main__":
    with job(snakemake.log):
        write_map(
            dict(snakemake.input.items()),
            snakemake.output.contact_map,
            (snakemake.wildcards.object, snakemake.wildcards.task),
            snakemake.params.seed,
            snakemake.params.settings,
        )
