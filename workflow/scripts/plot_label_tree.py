"""Draw the decision tree of the grasp types with the number of grasps in each leaf."""

from collections.abc import Mapping
from pathlib import PurePath

from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import VALID, dataset_schema
from grasptypes.labels.grasp_type import thresholds_of
from grasptypes.labels.label_pictures import save_figure
from grasptypes.labels.label_tree import draw_label_tree, typical_grasps
from grasptypes.renders.archives import read_named_pictures
from grasptypes.settings.grasp_types import LabellingRule
from grasptypes.tables import read_table


def plot_label_tree(
    hand: Hand, dataset: str, archives: Mapping[str, str], target: str, rule: LabellingRule
) -> None:
    """Write the figure.

    Args:
        dataset: of `dataset.dataset_schema`.
        archives: images of all grasps, by object.
    """
    table = read_table(dataset, dataset_schema(hand))
    counts = table[table.reason == VALID].GraspType.value_counts().to_dict()
    pictures = {
        name: read_named_pictures(archives[row.Object])[PurePath(row.Image).name]
        for name, row in typical_grasps(table).items()
    }
    rejected = int((table.reason != VALID).sum())
    save_figure(draw_label_tree(counts, rejected, thresholds_of(rule, hand), pictures), target)


if __name__ == "__main__":
    with job(snakemake.log):
        plot_label_tree(
            load_hand(snakemake.params.hand["name"]),
            snakemake.input.dataset,
            dict(zip(snakemake.params.objects, snakemake.input.pictures, strict=True)),
            snakemake.output.figure,
            LabellingRule.check(snakemake.params.settings),
        )
