"""Sections `backbone` to `generalisation`: features, folds, predictors and their training."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from grasptypes.settings.base import Settings, Share, Triple, Unique, setting

NO_TASK = "none"  # images and features without a task, next to those of the tasks


class BackboneSettings(Settings):
    """The network whose features the predictors read."""

    input_px: int = setting("size of the network's input image", ge=32, le=1024)
    timeout_s: float = setting("how long to wait for an unreachable host", ge=0, le=60)


class FeatureSettings(Settings):
    """Frozen features of the images."""

    batch: int = setting("images per batch", ge=1, le=4096)


class FoldSettings(Settings):
    """Stratified folds over images."""

    count: int = setting("number of folds", ge=2, le=100)


class FineTuning(Settings):
    """Training of the backbone."""

    last_blocks: int = setting("number of blocks from the end for last_blocks", ge=1, le=100)
    learning_rate: float = setting("of the head and the backbone's last blocks", gt=0, le=1)
    epochs: int = setting("passes over the training images", ge=1, le=1000)
    batch: int = setting("images per step", ge=1, le=4096)


class PredictorSettings(Settings):
    """The head of four fully connected layers and its training."""

    seeds: int = setting("repetitions of every fold", ge=1, le=100)
    hidden: Triple[Annotated[int, Field(ge=1, le=4096)]] = setting(
        "outputs of the first three layers"
    )
    components: int = setting(
        "number of feature directions in which the first layer is trained", ge=1, le=4096
    )
    whitening: Share = setting("0 leaves the directions' variances, 1 makes them equal")
    epochs: int = setting("passes over the training examples", ge=1, le=10000)
    batch: int = setting("examples per step", ge=1, le=65536)
    learning_rate: float = setting("largest step of AdamW", gt=0, le=1)
    warm_up: float = setting("share of the steps in which the learning rate rises", gt=0, lt=1)
    weight_decay: float = setting("of AdamW", ge=0, le=10)
    dropout: float = setting(
        "share of the first two layers' outputs dropped in training", ge=0, lt=1
    )
    probability_weight: float = setting(
        "weight of the probability vector's cross-entropy", ge=0, le=1000
    )
    finetune: Literal["none", "last_blocks", "all"] = setting(
        "part of the backbone that is trained"
    )
    finetuning: FineTuning

    @property
    def frozen(self) -> bool:
        """Whether the backbone stays as it is, so that its features can be computed beforehand."""
        return self.finetune == "none"


class VariantTrial(Settings):
    """Numbers of shapes per object, and of images per shape, in the training set."""

    shapes: int = setting("shapes of an object, including itself", ge=1, le=100)
    views: int = setting("images per shape", ge=1, le=1000)


class GeneralisationSettings(Settings):
    """Leave-one-object-out with variants."""

    trials: Unique[VariantTrial] = setting(
        "numbers of shapes per object, and of images per shape, in the training set", min_length=1
    )
    seeds: int = setting("repetitions with different random starts", ge=1, le=100)
