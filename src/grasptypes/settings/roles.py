"""What a part of an object is for: the vocabulary in roles.yaml, and the role of one part."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Annotated, Self

from pydantic import AfterValidator, model_validator

from grasptypes.settings.base import MisplacedError, Name, Settings, Unique, setting
from grasptypes.yaml_files import read_yaml

ROLES = Path(__file__).with_suffix(".yaml")


class Attribute(Settings):
    """A property of a part that matters to the hand, such as sharp."""

    meaning: str = setting("what it means, in words", min_length=1)
    hazardous: bool = setting("hurts or soils a hand")


class Role(Settings):
    """What a part is for, such as handle."""

    meaning: str = setting("what it means, in words", min_length=1)
    attributes: Unique[Name] = setting("attributes that every part with this role has")


class RoleVocabulary(Settings):
    """All roles and attributes."""

    attributes: dict[Name, Attribute] = setting("attributes by name", min_length=1)
    roles: dict[Name, Role] = setting("roles by name", min_length=1)

    @model_validator(mode="after")
    def _knows_attributes(self) -> Self:
        for name, role in self.roles.items():
            for attribute in role.attributes:
                if attribute not in self.attributes:
                    message = f"'{attribute}' is not one of {', '.join(self.attributes)}"
                    raise MisplacedError(f"roles.{name}.attributes", message)
        return self


@cache
def read_roles(path: str | Path = ROLES) -> RoleVocabulary:
    """The vocabulary.

    Raises:
        InputError: names the file and the key of the first mistake.
    """
    return RoleVocabulary.check(read_yaml(path), path)


def _known_role(name: str) -> str:
    if name not in read_roles().roles:
        raise ValueError(f"'{name}' is not a role; allowed: {', '.join(read_roles().roles)}")
    return name


def _known_attribute(name: str) -> str:
    if name not in read_roles().attributes:
        allowed = ", ".join(read_roles().attributes)
        raise ValueError(f"'{name}' is not an attribute; allowed: {allowed}")
    return name


RoleName = Annotated[str, AfterValidator(_known_role)]
AttributeName = Annotated[str, AfterValidator(_known_attribute)]


class PartRole(Settings):
    """The role of one part, and its attributes beyond those of the role."""

    role: RoleName = setting("what the part is for, a role of roles.yaml")
    attributes: Unique[AttributeName] = setting(
        "attributes of roles.yaml beyond those of the role", default=()
    )

    @property
    def all_attributes(self) -> tuple[str, ...]:
        """The part's own attributes after those of its role."""
        return tuple(dict.fromkeys((*read_roles().roles[self.role].attributes, *self.attributes)))

    @property
    def hazardous(self) -> bool:
        """Whether a hand should keep away from the part."""
        return any(read_roles().attributes[name].hazardous for name in self.all_attributes)
