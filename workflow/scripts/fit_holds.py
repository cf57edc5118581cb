"""Fit the free numbers of the table of holds to published labels, and test them on others."""

from pathlib import Path

from grasptypes.contact_maps.contact_map import MapTask
from grasptypes.contact_maps.hold_fit import Problem, free_parameters, hold_problem
from grasptypes.contact_maps.places import HeldObject
from grasptypes.jobs import job
from grasptypes.labels.samples import COUNT_SCHEMA, COUNTS
from grasptypes.objects.object_geometry import read_object
from grasptypes.reports.hold_similarity import (
    PARAMETER_SCHEMA,
    SIMILARITY_SCHEMA,
    compare_holds,
    compare_parameters,
)
from grasptypes.settings.contact_maps import ContactMapSettings
from grasptypes.settings.grasp_types import Softness, Thresholds
from grasptypes.settings.holds import HoldFitSettings, HoldTable, read_hold_table
from grasptypes.settings.tasks import read_tasks
from grasptypes.tables import read_table, write_table


def problem_of(
    folder: str | Path,
    task: str,
    table: HoldTable,
    settings: ContactMapSettings,
    rule: tuple[Thresholds, Softness],
    seed: int,
) -> Problem:
    """The holds of a prepared object for a task."""
    geometry = read_object(folder)
    drawn = MapTask.of_object(geometry, (geometry.name, task), seed, settings)
    held = HeldObject.of_geometry(geometry, drawn.points)
    return hold_problem(held, read_tasks()[task], table, drawn.typical_hand(), rule)


if __name__ == "__main__":
    with job(snakemake.log) as log:
        params = snakemake.params
        table, settings = read_hold_table(), HoldFitSettings.check(params.settings)
        maps = ContactMapSettings.check(params.contact_maps)
        rule = (
            Thresholds.check(params.grasp_types["thresholds"]),
            Softness.check(params.grasp_types["softness"]),
        )
        counts = read_table(snakemake.input.published, COUNT_SCHEMA).set_index(["object", "task"])
        folders = {Path(path).parent.name: Path(path).parent for path in snakemake.input.properties}
        keys = [(name, task) for name in folders for task in params.tasks]
        published = {key: counts.loc[key, list(COUNTS)].to_numpy(float) for key in keys}
        problems = {
            (name, task): problem_of(folders[name], task, table, maps, rule, params.seed)
            for name, task in keys
        }
        parameters = free_parameters(table, settings)
        used = params.fitted_on
        similarity = compare_holds(
            parameters, problems, published, used, maps.sessions, table.rarest, settings
        )
        write_table(similarity, snakemake.output.similarity, SIMILARITY_SCHEMA)
        fitted = compare_parameters(parameters, problems, published, used, settings)
        write_table(fitted, snakemake.output.parameters, PARAMETER_SCHEMA)
