"""Roles of parts: the vocabulary is consistent, and a wrong role is one clear line."""

import pytest

from grasptypes.errors import InputError
from grasptypes.kinds.catalogue import build, object_names
from grasptypes.settings.roles import PartRole, RoleVocabulary, read_roles


@pytest.mark.parametrize("name", object_names())
def test_every_part_of_the_catalogue_has_a_role(name):
    assert all(part.role is not None for part in build(name).parts)


def test_a_part_has_the_attributes_of_its_role_first():
    blade = PartRole.check({"role": "blade", "attributes": ["wet", "sharp"]})
    assert blade.all_attributes == ("sharp", "wet")
    assert blade.hazardous
    assert not PartRole.check({"role": "ball", "attributes": ["fragile"]}).hazardous


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ({"role": "grip"}, "x.yaml: role: 'grip' is not a role; allowed: handle, bail"),
        (
            {"role": "ball", "attributes": ["heavy"]},
            "x.yaml: attributes.0: 'heavy' is not an attribute; allowed: sharp, hot",
        ),
        ({"attributes": []}, "x.yaml: 'role' is missing"),
        ({"role": "ball", "attributes": ["hot", "hot"]}, "attributes: 'hot' is listed twice"),
        ({"role": "ball", "colour": "red"}, "'colour' is not a known key"),
    ],
)
def test_wrong_roles_are_named(block, message):
    with pytest.raises(InputError) as caught:
        PartRole.check(block, "x.yaml")
    assert message in str(caught.value)


def test_a_role_with_an_unknown_attribute_is_named():
    content = read_roles().model_dump(mode="json")
    content["roles"]["blade"]["attributes"] = ["pointy"]
    with pytest.raises(InputError) as caught:
        RoleVocabulary.check(content, "roles.yaml")
    assert "roles.yaml: roles.blade.attributes: 'pointy' is not one of" in str(caught.value)
