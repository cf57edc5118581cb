"""Lay out the images of all grasps of each object: one group per task, one image per session."""

from collections.abc import Mapping, Sequence

from grasptypes.files import write_bytes
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema
from grasptypes.renders.archives import read_named_pictures
from grasptypes.renders.renderer import png_bytes
from grasptypes.reports.session_pictures import session_groups
from grasptypes.reports.sheets import sheet
from grasptypes.settings.renders import SessionSheet
from grasptypes.tables import read_table


def plot_sessions(
    hand: Hand,
    dataset: str,
    archives: Mapping[str, str],
    targets: Mapping[str, str],
    tasks: Sequence[str],
    settings: SessionSheet,
    png_compression: int,
) -> None:
    """Write a sheet for each object.

    Args:
        dataset: of `dataset.dataset_schema`.
        archives: images by object.
        targets: files to write, by object.
    """
    table = read_table(dataset, dataset_schema(hand))
    for name, archive in archives.items():
        rows = table[table.Object == name]
        groups = session_groups(rows, read_named_pictures(archive), tasks)
        whole = sheet(groups, settings.columns, settings.tile_px)
        write_bytes(targets[name], png_bytes(whole, png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        objects: Sequence[str] = snakemake.params.objects
        plot_sessions(
            load_hand(snakemake.params.hand["name"]),
            snakemake.input.dataset,
            dict(zip(objects, snakemake.input.pictures, strict=True)),
            dict(zip(objects, snakemake.output.sheets, strict=True)),
            snakemake.params.tasks,
            SessionSheet.check(snakemake.params.settings),
            snakemake.params.png_compression,
        )
