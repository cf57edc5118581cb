"""Compare prepared objects with a folder of reference meshes; without one, keep the table."""

import os
from pathlib import Path

from grasptypes.errors import InputError
from grasptypes.jobs import job
from grasptypes.objects.reference_meshes import REFERENCES
from grasptypes.objects.shape_comparison import SHAPE_TABLE, compare_folder
from grasptypes.tables import write_table


def compare_shapes(
    objects: list[Path], references: str, samples: dict[str, int], target: Path
) -> str:
    """Write the table of comparisons, or keep it without references; returns a line to log.

    Args:
        objects: folders of prepared objects.
        references: folder of `<object>.stl`; empty if the user has none.
    """
    if references:
        table = compare_folder(objects, Path(references), **samples)
        write_table(table, target, SHAPE_TABLE)
        return f"compared {len(table)} objects with {references}"
    if not target.exists():
        raise InputError(REFERENCES, "", f"is not set and there is no {target} to keep")
    return f"{REFERENCES} is not set: {target} stays as it is"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        line = compare_shapes(
            [Path(path).parent for path in snakemake.input.properties],
            os.environ.get(REFERENCES, ""),
            snakemake.params.samples,
            Path(snakemake.output.table),
        )
        log.info(line)
