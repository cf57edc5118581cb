"""Plan grasps of a scan with and without its parts, and judge them by its true roles."""

from pathlib import Path

import pandas as pd

from grasptypes.jobs import job
from grasptypes.objects.loading import load_object
from grasptypes.planning.part_plans import PART_PLAN_SCHEMA, study_plans
from grasptypes.planning.sessions import PlanningContext
from grasptypes.segmentation.true_roles import read_slices, true_roles
from grasptypes.settings.params import Params
from grasptypes.tables import write_table


def plan_scan(
    name: str, path: Path, scale: float, mass_kg: float | None, slices: pd.DataFrame, params: Params
) -> pd.DataFrame:
    """The rows of a scan for all tasks."""
    objects = params.objects
    geometry = load_object(path, scale=scale, mass_kg=mass_kg, name=name, settings=objects)
    true = true_roles(geometry, slices, scale, objects.resolution)
    contexts = [PlanningContext(geometry, task, name, params.hand, params) for task in params.tasks]
    touch = params.hold_fit.touch
    return pd.DataFrame([row for each in contexts for row in study_plans(each, true, touch)])


if __name__ == "__main__":
    with job(snakemake.log):
        given = snakemake.params
        table = plan_scan(
            snakemake.wildcards.scan,
            Path(given.file),
            given.scale,
            given.mass_kg,
            read_slices(given.slices),
            Params.check(given.params),
        )
        write_table(table, snakemake.output.table, PART_PLAN_SCHEMA)
