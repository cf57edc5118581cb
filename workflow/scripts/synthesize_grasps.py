"""Synthesize a grasp for every session of an object and task, and test it in physics."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from grasptypes.contact_maps.contact_map_files import read_contact_map
from grasptypes.jobs import job
from grasptypes.synthesis.grasps import ATTEMPT_SCHEMA, GRASP_SCHEMA
from grasptypes.synthesis.holding import PhysicsSettings, read_body
from grasptypes.synthesis.physics import physics
from grasptypes.synthesis.search import read_thing
from grasptypes.synthesis.settings import sampled_hand, search_settings
from grasptypes.synthesis.trials import Problem, ValiditySettings, synthesize
from grasptypes.tables import write_table


def write_grasps(
    inputs: Mapping[str, str | Path],
    outputs: Mapping[str, str | Path],
    name: tuple[str, str],
    seed_number: int,
    synthesis: Mapping[str, Any],
    physics_params: Mapping[str, Any],
) -> None:
    """Write the grasps and attempts of `name` (object, task).

    Args:
        inputs: distance_grid, properties, collision, contact_map and hand (its URDF).
        outputs: grasps and attempts.
        synthesis, physics_params: those sections of params.yaml.
    """
    contact_map = read_contact_map(inputs["contact_map"])
    thing = read_thing(inputs["distance_grid"], inputs["properties"], contact_map)
    problem = Problem(*name, thing, contact_map, seed_number)
    body = read_body(inputs["collision"], inputs["properties"])
    validity = ValiditySettings(**physics_params["validity"])
    with physics(inputs["hand"], body, PhysicsSettings(**physics_params["test"])) as world:
        grasps, attempts = synthesize(
            problem, sampled_hand(synthesis), world, search_settings(synthesis), validity
        )
    write_table(grasps, outputs["grasps"], GRASP_SCHEMA)
    write_table(attempts, outputs["attempts"], ATTEMPT_SCHEMA)


if __name__ == "__main__":
    with job(snakemake.log):
        write_grasps(
            snakemake.input,
            snakemake.output,
            (snakemake.wildcards.object, snakemake.wildcards.task),
            snakemake.params.seed,
            snakemake.params.synthesis,
            snakemake.params.physics,
        )
