"""Test the recorded grasps of an object in both engines."""

from pathlib import Path

import pandas as pd

from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema
from grasptypes.objects.object_geometry import ObjectGeometry, read_object
from grasptypes.robustness.grasp_tests import GraspTestsSettings, test_grasps
from grasptypes.robustness.tables import ROBUSTNESS_SCHEMA
from grasptypes.settings.physics import PhysicsSettings
from grasptypes.settings.robustness import RobustnessSettings
from grasptypes.settings.synthesis import SynthesisSettings
from grasptypes.tables import read_table, write_table


def test_object(
    dataset: str, hand: Hand, geometry: ObjectGeometry, settings: GraspTestsSettings
) -> pd.DataFrame:
    """The tests of the rows of the dataset that hold an object, of the first sessions."""
    table = read_table(dataset, dataset_schema(hand))
    first = table[table.Session <= settings.robustness.sessions]
    return test_grasps(first[first.Object == geometry.name], hand, geometry, settings)


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        tests = test_object(
            snakemake.input.grasps,
            load_hand(params.hand["name"]),
            read_object(Path(snakemake.input.properties).parent),
            GraspTestsSettings(
                PhysicsSettings.check(params.physics),
                RobustnessSettings.check(params.robustness),
                SynthesisSettings.check(params.synthesis),
                params.seed,
            ),
        )
        write_table(tests, snakemake.output.tests, ROBUSTNESS_SCHEMA)
