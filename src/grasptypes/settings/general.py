"""Section `general`: the predictor for unseen objects, and the images that it is trained on."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, TypeAdapter, ValidationError, model_validator

from grasptypes.settings.base import (
    Between,
    Many,
    MisplacedError,
    Name,
    Pair,
    Settings,
    Share,
    Unique,
    setting,
    upwards,
)

Positive = Annotated[Pair[Annotated[float, Field(gt=0, le=1000)]], AfterValidator(upwards)]


class ViewDraws(Settings):
    """From where an image is taken."""

    any_side: Share = setting("share of images from any side; the others are from above")
    elevation_rad: Between = setting("of the camera above the object's xy plane, if from above")
    roll_rad: float = setting("largest rotation of the camera about its axis, if from above", ge=0)
    field_of_view_rad: Positive = setting("full angle of an image")
    fill: Positive = setting("share of half the image that the object reaches")
    shift: Share = setting("largest shift of the object, as a share of half the image")


class LightDraws(Settings):
    """Light and surfaces."""

    strength: Positive = setting("factor on each light")
    ambient: Positive = setting("ambient light, linear")
    spread: float = setting("standard deviation of unit directions", ge=0, le=10)
    colours: Share = setting("share of images in which the object has colours")
    moved: Share = setting("largest share by which colours are moved towards random ones")
    roughness: Positive = setting("factor on the roughness of materials")
    shadow: Share = setting("share of images with a shadow on the ground")


class GroundDraws(Settings):
    """What is behind the object; the shares of grounds, the rest is plain."""

    gradient: Share = setting("share of images with a gradient between two colours")
    noise: Share = setting("share with noise whose spectrum falls as that of natural images")
    pattern: Share = setting("share with wavy stripes or checks")
    exponent: Positive = setting("with which the noise's amplitude falls with frequency")
    periods: Positive = setting("number of stripes or checks across the image")


class LensDraws(Settings):
    """What happens to the light on its way to the file."""

    hidden: Share = setting("share of images in which something covers a part of the object")
    cover: Positive = setting("half axes of what covers, as a share of the image")
    most_hidden: Share = setting("largest share of the object that is covered")
    exposure: Positive = setting("factor on all levels")
    contrast: Positive = setting("exponent of the tone curve")
    white_balance: float = setting("standard deviation of the logarithm of each colour", ge=0, le=1)
    blur_px: Between = setting("standard deviation of the blur")
    noise: Between = setting("standard deviation of the noise, levels of 255")
    jpeg_quality: Annotated[Pair[Annotated[int, Field(ge=1, le=95)]], AfterValidator(upwards)] = (
        setting("quality of the JPEG file")
    )


class ImageSettings(Settings):
    """Randomised images of objects."""

    views: int = setting("images of each object", ge=1, le=1000)
    plain: Share = setting("share of images taken as in `renders`")
    view: ViewDraws
    light: LightDraws
    ground: GroundDraws
    lens: LensDraws


class ProtocolSettings(Settings):
    """How the predictor is tested."""

    folds: int = setting("groups of kinds, each held out in turn", ge=2, le=100)
    test_views: int = setting("images of each object that are tested", ge=1, le=1000)
    bins: int = setting("bins of the expected calibration error", ge=2, le=100)
    size_spread: float = setting(
        "standard deviation of the logarithm of an extent among objects of a kind", ge=0, le=10
    )
    mass_spread: float = setting("the same of the mass", ge=0, le=10)
    shape_directions: int = setting("principal directions of shapes in numbers", ge=1, le=100)
    families: dict[Name, Annotated[Unique[Name], Field(min_length=1)]] = setting(
        "families of kinds that each object of the paper is held out with"
    )


class MemorySettings(Settings):
    """How objects that were learned from are recognised."""

    last_features: int = setting("last features of an image; 0: no memory", ge=0, le=4096)
    temperature: float = setting("by which cosines are divided to be logits", gt=0, le=100)
    images_power: Share = setting("n images of one object count as n to this power")
    size_spread: float = setting("by which the logarithm of an extent may be off", gt=0, le=10)
    mass_spread: float = setting("the same of the mass", gt=0, le=10)
    known: float = setting("share of the objects shown that are like one learned from", gt=0, lt=1)


class HeadSettings(Settings):
    """The linear head, and its memory. Zero components leave an input out."""

    pictures: int = setting("principal directions of the features", ge=0, le=4096)
    classes: int = setting("principal directions of the classes' log-probabilities", ge=0, le=1000)
    facts: bool = setting("whether size and mass are inputs")
    whitening: Share = setting("0 leaves the directions' variances, 1 makes them equal")
    picture_scale: float = setting("factor on the features", gt=0, le=100)
    class_scale: float = setting("factor on the classes", gt=0, le=100)
    fact_scale: float = setting("factor on size and mass", gt=0, le=100)
    task_scale: float = setting("factor on the task", gt=0, le=100)
    weight_decay: float = setting("of all weights but the constant", ge=0, le=100)
    memory: MemorySettings


class StrangenessSettings(Settings):
    """Images like which nothing is known."""

    directions: int = setting("principal directions in which images may be strange", ge=1, le=4096)
    folds: int = setting("groups of objects, each held out in turn", ge=2, le=100)
    false_alarms: Share = setting("share of the images held out that are called strange")


# Trials that are not of the head.
KINDS, BACKBONE = "kinds", "backbone"
Backbone = Literal["mobilenet_v2", "efficientnet_lite0"]


class GeneralSettings(Settings):
    """The predictor for unseen objects."""

    images: ImageSettings
    backbone: Backbone = setting("network of the features")
    head: HeadSettings
    strangeness: StrangenessSettings
    protocol: ProtocolSettings
    trials: dict[str, Many[int | float | bool | str]] = setting(
        "values that keys of `head`, the number of kinds and the backbone take, one at a time",
        default={},
    )

    @model_validator(mode="after")
    def _trials_are_possible(self) -> Self:
        for key, values in self.trials.items():
            for index, value in enumerate(values):
                try:
                    self.trial(key, value)
                except ValidationError as error:
                    message = f"{value} is no value of {key}: {error.errors()[0]['msg']}"
                    raise MisplacedError(f"trials.{key}.{index}", message) from error
        return self

    def trial(self, key: str, value: float | str) -> tuple[HeadSettings, int]:
        """The head's settings and the number of kinds of a trial; 0 kinds are all."""
        if key == KINDS:
            return self.head, int(value)
        if key == BACKBONE:
            TypeAdapter(Backbone).validate_python(value)
            return self.head, 0
        section, _, name = key.rpartition(".")
        whole = self.head.model_dump()
        changed = {section: whole[section] | {name: value}} if section else {name: value}
        return HeadSettings.model_validate(whole | changed), 0
