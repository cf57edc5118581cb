"""Compare prepared objects with a folder of reference meshes."""

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
    """Write the table of comparisons; returns a line to log.

    Args:
        objects: folders of prepared objects.
        references: folder of `<object>.stl`; empty if the user has none.
    """
    if not references:
        raise InputError(REFERENCES, "", f"is not set; {target} needs it")
    table = compare_folder(objects, Path(references), **samples)
    write_table(table, target, SHAPE_TABLE)
    return f"compared {len(table)} objects with {references}"


if __name__ == "__main__":
    with job(snakemake.log) as log:
        line = compare_shapes(
            [Path(path).parent for path in snakemake.input.properties],
            os.environ.get(REFERENCES, ""),
            snakemake.params.samples,
            Path(snakemake.output.table),
        )
        log.info(line)
