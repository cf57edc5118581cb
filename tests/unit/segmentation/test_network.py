"""The network that names roles: its file, its training, and what the one in the package finds."""

from pathlib import Path

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.errors import InputError
from grasptypes.files import read_npz, write_npz
from grasptypes.kinds.modelling import build_shape
from grasptypes.segmentation import NETWORK
from grasptypes.segmentation.network import read_network, trained_network
from grasptypes.segmentation.parts import find_parts
from grasptypes.segmentation.samples import sample_roles, sample_shapes
from grasptypes.segmentation.training import train_network
from grasptypes.settings.params import checkout_params
from grasptypes.settings.roles import read_roles

SETTINGS = PARAMS.segmentation
KEY = ("test", 0)
ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def samples():
    return sample_shapes(
        ["egg_s01", "mallet_s01", "egg_s02", "mallet_s02"], SETTINGS.descriptors, SETTINGS.samples
    )


def test_it_learns_what_it_is_shown(samples, tmp_path):
    settings = SETTINGS.training.changed(epochs=60)
    network = train_network(samples, np.arange(4), settings, KEY)
    again = train_network(samples, np.arange(4), settings, KEY)
    assert all(map(np.array_equal, network.weights, again.weights))
    network.write(tmp_path / "network.npz")
    read = read_network(tmp_path / "network.npz")
    for shape in range(4):
        chances = network.probabilities(samples.descriptors[shape])
        assert chances.sum(axis=1) == pytest.approx(1)
        true = samples.roles[shape, : len(chances)]
        assert (chances.argmax(axis=1) == true).mean() > 0.8
        assert read.probabilities(samples.descriptors[shape]) == pytest.approx(chances, abs=0.02)


def test_a_file_that_lacks_a_layer_is_no_network(tmp_path):
    arrays = read_npz(NETWORK)
    del arrays["weights_2"]
    write_npz(tmp_path / "network.npz", arrays)
    with pytest.raises(InputError, match=r"network\.npz: weights_2"):
        read_network(tmp_path / "network.npz")


def test_the_network_of_the_package_knows_all_roles():
    assert trained_network().roles == tuple(read_roles().roles)


@pytest.mark.parametrize(
    ("shape", "roles"),
    [("mug_s01", {"container_wall", "handle"}), ("claw_hammer_s02", {"handle", "working_end"})],
)
def test_the_network_of_the_package_finds_large_parts(shape, roles):
    settings = checkout_params(ROOT).segmentation
    points_m, normals, true = sample_roles(build_shape(shape), shape, settings.descriptors.points)
    parts = find_parts(points_m, normals, settings)
    assert roles <= {part.role for part in parts.roles.values()}
    order = list(read_roles().roles)
    found = np.array([order.index(part.role) for part in parts.roles.values()])[parts.part_index]
    # The inside of the bottom looks like wall.
    assert (found == true).mean() > 0.6
