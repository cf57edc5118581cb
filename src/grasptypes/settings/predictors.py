"""Sections `backbone` to `generalisation`: what is learnt, and how."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from grasptypes.settings.base import Settings, Triple, Unique, setting


class BackboneSettings(Settings):
    """The network whose features the predictors read."""

    input_px: int = setting("size at which it sees a picture", ge=32, le=1024)
    timeout_s: float = setting("how long an unreachable host may hold things up", ge=0, le=60)


class FeatureSettings(Settings):
    """Frozen features of the images."""

    precision: Literal["fp32", "bf16"] = setting("number format of the network")
    batch: int = setting("pictures at once", ge=1, le=4096)


class FoldSettings(Settings):
    """Stratified folds over images."""

    count: int = setting("number of folds", ge=2, le=100)


class FineTuning(Settings):
    """Training of the backbone."""

    last_blocks: int = setting("how many blocks from the end last_blocks means", ge=1, le=100)
    learning_rate: float = setting("of the backbone's blocks", gt=0, le=1)
    epochs: int = setting("passes over the training pictures", ge=1, le=1000)
    batch: int = setting("pictures a step", ge=1, le=4096)


class PredictorSettings(Settings):
    """The head of four fully connected layers and its training."""

    seeds: int = setting("repetitions of every fold", ge=1, le=100)
    hidden: Triple[Annotated[int, Field(ge=1, le=4096)]] = setting(
        "outputs of the first three layers"
    )
    components: int = setting(
        "directions of the features the first layer is trained in", ge=1, le=4096
    )
    whitening: float = setting("0 leaves the directions' variances, 1 makes them equal", ge=0, le=1)
    epochs: int = setting("passes over the training examples", ge=1, le=10000)
    batch: int = setting("examples a step", ge=1, le=65536)
    learning_rate: float = setting("largest step of AdamW", gt=0, le=1)
    warm_up: float = setting("share of the steps in which the learning rate rises", gt=0, lt=1)
    weight_decay: float = setting("of AdamW", ge=0, le=10)
    dropout: float = setting("share of the first two layers' outputs left out", ge=0, lt=1)
    probability_weight: float = setting(
        "weight of the probability vector's cross-entropy", ge=0, le=1000
    )
    finetune: Literal["none", "last_blocks", "all"] = setting("what of the backbone is trained")
    finetuning: FineTuning

    @property
    def frozen(self) -> bool:
        """Whether the backbone stays as it is, so that its features can be computed beforehand."""
        return self.finetune == "none"


class VariantTrial(Settings):
    """How many shapes of an object, and images of each, a predictor learns from."""

    shapes: int = setting("shapes of an object, itself among them", ge=1, le=100)
    views: int = setting("pictures of a shape", ge=1, le=1000)


class GeneralisationSettings(Settings):
    """Leave-one-object-out with variants."""

    trials: Unique[VariantTrial] = setting(
        "how many shapes of an object, and pictures of each, a predictor learns from", min_length=1
    )
    seeds: int = setting("repetitions with other random starts", ge=1, le=100)
