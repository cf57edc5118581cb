"""Map where people touch an object for a task; one job per object and task."""

import logging
from pathlib import Path

from grasptypes.contact_maps.contact_map import ContactMap, MapTask, map_contacts
from grasptypes.contact_maps.contact_map_files import write_contact_map
from grasptypes.contact_maps.holds import object_holds
from grasptypes.contact_maps.measured_contacts import map_measured_contacts, read_probability
from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.objects.object_geometry import ObjectGeometry, read_object
from grasptypes.objects.units import UNITS_M
from grasptypes.segmentation.known_parts import known_parts
from grasptypes.segmentation.part_holds import part_holds
from grasptypes.segmentation.parts import described
from grasptypes.settings.contact_maps import ContactMapSettings
from grasptypes.settings.segmentation import PartSettings
from grasptypes.settings.tasks import read_tasks

LOGGER = logging.getLogger("grasptypes")


def draw_map(
    task: MapTask,
    geometry: ObjectGeometry,
    measured: str | Path | None,
    unit: str,
    settings: PartSettings,
) -> ContactMap:
    """The contact map: from a measured map (in its unit), else from roles, else from the shape."""
    if measured:
        probability = read_probability(measured, UNITS_M[unit], task)
        return map_measured_contacts(task, probability, measured)
    if geometry.properties.roles:
        return map_contacts(task, object_holds(task, geometry))
    parts = known_parts(geometry, task.points, settings)
    LOGGER.warning("%s: parts by %s: %s", geometry.name, parts.basis, described(parts))
    seen, holds = part_holds(task, geometry, parts, read_tasks()[task.name[1]], settings)
    if not holds:
        message = f"people hold none of its parts for {task.name[1]}: {described(parts)}"
        raise InputError(geometry.name, "", message)
    return map_contacts(seen, holds)


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
        segmentation = PartSettings.check(params.segmentation)
        contact_map = draw_map(task, geometry, inputs.measured, params.unit, segmentation)
        write_contact_map(contact_map, snakemake.output.contact_map)
