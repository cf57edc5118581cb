"""Every object of the catalogue: a solid of named parts, as large and heavy as such things are."""

import numpy as np
import pytest

from grasptypes.objects.catalogue import OBJECTS
from grasptypes.objects.preparation import physical_properties
from grasptypes.settings.objects import CATALOGUE


def test_the_settings_name_the_same_objects():
    assert sorted(CATALOGUE) == sorted(OBJECTS)
    assert len(OBJECTS) == 19


@pytest.mark.parametrize("name", OBJECTS)
def test_objects_are_bodies_one_can_hold(name):
    model = OBJECTS[name]()
    for part in model.parts:
        assert part.solid.volume() > 0, part.name
    found = physical_properties(name, model, 1.0)
    low, high = np.array(found.bounds_m)
    assert 0.03 < (high - low).max() < 0.45
    assert 0.005 < found.mass_kg < 1.5
    centre_m = np.array(found.centre_of_mass_m)
    assert (low < centre_m).all()
    assert (centre_m < high).all()
    moments = np.linalg.eigvalsh(found.inertia_kg_m2)
    assert moments[0] > 0
    assert moments[2] <= moments[0] + moments[1]


@pytest.mark.parametrize("name", OBJECTS)
def test_an_object_is_built_the_same_every_time(name):
    first, second = (OBJECTS[name]().parts for _ in range(2))
    assert [part.name for part in first] == [part.name for part in second]
    for one, other in zip(first, second, strict=True):
        assert one.solid.volume() == other.solid.volume()
