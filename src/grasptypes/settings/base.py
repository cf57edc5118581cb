"""Base of all settings: strict types, no unknown keys, and a one-line message for errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Self, TypeVar, get_args

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationError,
)

from grasptypes.errors import InputError

T = TypeVar("T")

# Units, by the suffix of a key's name.
_UNITS = {
    "_kg_m3": "kg/m3", "_m_s2": "m/s2", "_rad_s": "rad/s", "_kg": "kg", "_m3": "m3", "_m": "metres",
    "_rad": "radians", "_deg": "degrees", "_s": "seconds", "_n": "newtons", "_nm": "newton metres",
    "_px": "pixels", "_mb": "MB", "_lux": "lux",
}  # fmt: skip
# Messages by type of pydantic error; the others keep pydantic's own message.
_PROBLEMS = {
    "int_type": "is not an integer",
    "int_from_float": "is not an integer",
    "float_type": "is not a number",
    "finite_number": "is not a finite number",
    "bool_type": "is neither true nor false",
    "string_type": "is not text",
    "string_too_short": "is empty",
    "greater_than_equal": "is below the minimum of {ge:g}",
    "greater_than": "is not greater than {gt:g}",
    "less_than_equal": "is above the maximum of {le:g}",
    "less_than": "is not less than {lt:g}",
    "literal_error": "is not one of {expected}",
    "tuple_type": "is not a list",
    "too_short": "has too few values: at least {min_length} needed",
    "too_long": "has too many values: at most {max_length} allowed",
    "dict_type": "is not a mapping",
    "model_type": "is not a mapping",
    "string_pattern_mismatch": "is invalid: use lower-case letters, digits and underscores",
}


class MisplacedError(ValueError):
    """A value within its own limits that conflicts with another value.

    Args:
        key: dotted key within the section that raises it; empty for the section itself.
        message: what is wrong and what is allowed.
    """

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key = key


def _unique(values: tuple[T, ...]) -> tuple[T, ...]:
    for index, value in enumerate(values):
        if value in values[:index]:
            raise ValueError(f"'{value}' is listed twice")
    return values


def _present(name: str) -> str:
    if name in ("nan", "null"):
        raise ValueError(f"'{name}' means a missing value in tables: choose another name")
    return name


def upwards(values: tuple[float, float]) -> tuple[float, float]:
    """A range, lower end first; raises ValueError."""
    low, high = values
    if low > high:
        raise ValueError(f"{low:g} is above {high:g}: give the smaller one first")
    return values


# Tuples instead of YAML's lists: settings shared by all jobs of a run must not change.
Many = Annotated[tuple[T, ...], Field(strict=False)]
Unique = Annotated[tuple[T, ...], Field(strict=False), AfterValidator(_unique)]
Pair = Annotated[tuple[T, T], Field(strict=False)]
Triple = Annotated[tuple[T, T, T], Field(strict=False)]
Between = Annotated[Pair[float], AfterValidator(upwards)]
# Limits that many keys have.
Share = Annotated[float, Field(ge=0, le=1)]
Weight = Annotated[float, Field(ge=0, le=100_000)]
# Safe in file names and shells, and preserved by every table.
Name = Annotated[str, StringConstraints(pattern="^[a-z][a-z0-9_]*$"), AfterValidator(_present)]


def setting(meaning: str, **limits: Any) -> Any:
    """A key of params.yaml: its meaning (the name ends in the unit) and limits."""
    return Field(description=meaning, **limits)


class Settings(BaseModel):
    """A section of params.yaml, checked on creation and immutable.

    100.0 is not an integer; `true`, NaN and infinity are not numbers.
    """

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, validate_by_name=True
    )

    @classmethod
    def check(cls, content: Mapping[str, Any], path: str | Path = "params.yaml") -> Self:
        """The settings in `content`.

        Raises:
            InputError: names the file, the first wrong key, what is wrong, and what is allowed.
        """
        try:
            return cls.model_validate(content)
        except ValidationError as error:
            raise explained(error, cls, path) from error

    def changed(self, **values: Any) -> Self:
        """The same settings with other values, which are not checked."""
        return self.model_copy(update=values)


def explained(error: ValidationError, section: type[Settings], path: str | Path) -> InputError:
    """The first mistake as one line; unknown keys are reported before missing ones."""
    first = min(error.errors(), key=lambda found: found["type"] != "extra_forbidden")
    keys = [part for part in first["loc"] if part != "[key]"]
    problem, context = first["type"], first.get("ctx", {})
    if problem == "missing" and isinstance(keys[-1], int):
        said = f"has only {keys.pop()} values: more are needed"
    elif problem in ("extra_forbidden", "missing"):
        *keys, name = keys
        owner = _described(section, keys)[0]
        allowed = ", ".join(sorted(field.alias or key for key, field in owner.model_fields.items()))
        said = f"'{name}' is missing"
        if problem == "extra_forbidden":
            said = f"'{name}' is not a known key; allowed: {allowed}"
    elif problem == "json_invalid":
        said = f"is not JSON: {context['error']}"
    elif problem == "value_error":
        cause = context["error"]
        said, inner = str(cause), getattr(cause, "key", "")
        keys += [inner] if inner else []
    else:
        of_a_key = "[key]" in first["loc"]
        value = keys.pop() if of_a_key else first["input"]
        template = _PROBLEMS.get(problem)
        shown = repr(value) if isinstance(value, str) or value is None else str(value)
        said = f"{shown} {template.format(**context)}" if template else f"{shown}: {first['msg']}"
        meaning = "" if of_a_key else _described(section, keys)[1]
        said += f" ({meaning})" if meaning else ""
    return InputError(path, ".".join(map(str, keys)), said)


def _described(section: type[Settings], keys: Sequence[int | str]) -> tuple[type[Settings], str]:
    """The innermost section that keys lead to, and the meaning and unit of the last key."""
    meaning = ""
    for key in keys:
        fields = {field.alias or name: field for name, field in section.model_fields.items()}
        if key in fields:
            field = fields[key]
            unit = next((unit for end, unit in _UNITS.items() if str(key).endswith(end)), "")
            meaning = ", ".join(filter(None, [field.description, unit]))
            section = next(_sections(field.annotation), section)
    return section, meaning


def _sections(annotation: Any) -> Iterator[type[Settings]]:
    """The sections that a type contains."""
    if isinstance(annotation, type) and issubclass(annotation, Settings):
        yield annotation
    for part in get_args(annotation):
        yield from _sections(part)
