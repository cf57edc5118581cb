"""Synthesize a grasp for every session of an object and task, and test it in physics."""

from collections.abc import Mapping
from pathlib import Path

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.objects.object_geometry import read_object
from grasptypes.physics.loads import task_load
from grasptypes.settings.physics import GraspTestSettings
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.settings.tasks import read_tasks
from grasptypes.synthesis.grasps import ATTEMPT_SCHEMA, GRASP_SCHEMA
from grasptypes.synthesis.trials import SynthesisTask, synthesize
from grasptypes.tables import write_table


def write_grasps(
    task: SynthesisTask,
    hand: Hand,
    settings: tuple[SynthesisSettings, GraspTestSettings],
    outputs: Mapping[str, str | Path],
) -> None:
    """Write the tables of grasps and attempts of a task and a hand."""
    grasps, attempts = synthesize(task, hand, *settings)
    write_table(grasps, outputs["grasps"], GRASP_SCHEMA)
    write_table(attempts, outputs["attempts"], ATTEMPT_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        inputs, params = snakemake.input, snakemake.params
        test = GraspTestSettings.check(params.physics)
        geometry, task = read_object(Path(inputs.properties).parent), snakemake.wildcards.task
        write_grasps(
            SynthesisTask(
                snakemake.wildcards.object,
                task,
                geometry,
                read_contact_map(inputs.contact_map),
                params.seed,
                task_load(read_tasks()[task], geometry, test.test.gravity_m_s2),
            ),
            load_hand(params.hand["name"]),
            (SynthesisSettings.check(params.synthesis), test),
            snakemake.output,
        )
