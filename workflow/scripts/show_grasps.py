"""Write the page on which all grasps of the dataset can be turned and closed."""

from pathlib import Path

from grasptypes.files import write_text
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.viewer.grasp_views import dataset_views
from grasptypes.viewer.page import page


def show_grasps(dataset: str | Path, hand: str, target: str | Path) -> None:
    """Write the page of a dataset that is beside its objects, contact maps and grasps."""
    write_text(target, page(dataset_views(Path(dataset), load_hand(hand))))


if __name__ == "__main__":
    with job(snakemake.log):
        show_grasps(snakemake.input.dataset, snakemake.params.hand["name"], snakemake.output.page)
