"""Map where people touch an object for a task; one job per object and task."""

from pathlib import Path

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, map_contacts
from grasptypes.contact_maps.contact_map_files import write_contact_map
from grasptypes.contact_maps.holds import object_holds
from grasptypes.contact_maps.measured_contacts import map_measured_contacts, read_probability
from grasptypes.jobs import job
from grasptypes.objects.object_geometry import ObjectGeometry, read_object
from grasptypes.objects.units import UNITS_M
from grasptypes.settings.contact_maps import ContactMapSettings


def draw_map(
    task: MapTask, geometry: ObjectGeometry, measured: str | Path | None, unit: str
) -> ContactMap:
    """The contact map: from a measured map (in its unit) if there is one, else from the roles."""
    if measured:
        probability = read_probability(measured, UNITS_M[unit], task)
        return map_measured_contacts(task, probability, measured)
    return map_contacts(task, object_holds(task, geometry))


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        geometry = read_object(Path(inputs.properties).parent)
        task = MapTask.of_object(
            geometry,
            (snakemake.wildcards.object, snakemake.wildcards.task),
            params.seed,
            ContactMapSettings.check(params.settings),
        )
        contact_map = draw_map(task, geometry, inputs.measured, params.unit)
        write_contact_map(contact_map, snakemake.output.contact_map)
