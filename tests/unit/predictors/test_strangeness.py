"""Images of something else than what was learned are strange."""

import numpy as np
import pytest
from tests.unit.settings import PARAMS

from grasptypes.predictors.general_inputs import Pictures
from grasptypes.predictors.strangeness import Strangeness

SETTINGS = PARAMS.general.strangeness
NAMES = ("ball", "cup", "fork", "jar", "key", "mop", "pin", "saw")
FEATURES, VIEWS = 30, 6


@pytest.fixture(scope="module")
def shown():
    """Images of each object: a direction an object, with noise."""
    places = np.repeat(np.arange(len(NAMES)), VIEWS)
    noise = np.random.default_rng(0).normal(0, 0.2, (len(places), FEATURES))
    rows = noise + 3 * np.eye(FEATURES)[places]
    return Pictures(np.repeat(NAMES, VIEWS), rows, np.zeros((len(rows), 0)))


@pytest.fixture(scope="module")
def strangeness(shown):
    return Strangeness.of(shown, {name: frozenset([name]) for name in NAMES}, SETTINGS, 0)


def test_the_limit_is_passed_by_few_images_of_what_was_learned_and_all_others(shown, strangeness):
    assert (strangeness(shown.features) > 1).mean() <= 0.1
    assert (strangeness(-5 * shown.features) > 1).all()


def test_the_limit_follows_from_the_alarms_allowed(shown, strangeness):
    families = {name: frozenset([name]) for name in NAMES}
    more = Strangeness.of(shown, families, SETTINGS.changed(false_alarms=0.5), 0)
    assert more.limit < strangeness.limit
    assert (more(shown.features) > 1).sum() >= (strangeness(shown.features) > 1).sum()
