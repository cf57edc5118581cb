"""Plan grasps of a scan with and without the parts that its shape shows, and judge them by its
true roles."""

from pathlib import Path

import pandas as pd

from grasptypes.jobs import job
from grasptypes.kinds.catalogue import build
from grasptypes.objects.loading import load_object
from grasptypes.objects.preparation import part_surface, scaled_parts
from grasptypes.planning.part_plans import PART_PLAN_SCHEMA, TrueRoles, study_plans
from grasptypes.planning.sessions import PlanningContext
from grasptypes.settings.params import Params
from grasptypes.tables import write_table


def plan_scan(path: Path, params: Params) -> pd.DataFrame:
    """The rows of a scan for all tasks."""
    resolution, scale = params.objects.resolution, params.objects.scale
    models = scaled_parts(build(path.stem), scale)
    surface = part_surface(models, resolution.surface_tolerance_m, resolution.surface_edge_m)
    role_of = {part.name: part.role for part in models if part.role}
    names = [str(surface.part_names[index]) for index in surface.part_index]
    true = TrueRoles(surface.vertices, [role_of[name] for name in names])
    geometry = load_object(path, scale=scale, settings=params.objects)
    return pd.DataFrame(
        [
            row
            for task in params.tasks
            for row in study_plans(
                PlanningContext(geometry, task, path.stem, params.hand, params),
                true,
                params.hold_fit.touch,
            )
        ]
    )


if __name__ == "__main__":
    with job(snakemake.log):
        table = plan_scan(Path(snakemake.params.scan), Params.check(snakemake.params.params))
        write_table(table, snakemake.output.table, PART_PLAN_SCHEMA)
