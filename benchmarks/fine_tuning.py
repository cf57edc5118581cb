"""Fine-tuning of the last blocks of a backbone, from what its first blocks make of the images.

The first blocks stay as they are, so their output is computed once instead of in every epoch. What
is trained, and how, is that of the workflow (`predictors.finetune: last_blocks`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import torch
from torch import Tensor

from grasptypes.predictors.backbone import Backbone
from grasptypes.predictors.features import shift_colours


class LastBlocks(Backbone):
    """The last blocks, for rows of `first_blocks`: of one image, or of several beside each other.

    Args:
        backbone: all blocks; its last ones are used.
        count: number of last blocks.
        shape: channels, height and width of their input.
        pictures: images of a row.
    """

    def __init__(
        self, backbone: Backbone, count: int, shape: tuple[int, int, int], pictures: int = 1
    ) -> None:
        kind = backbone.kind
        super().__init__(list(backbone.blocks)[-count:], kind, backbone.input_px)
        self.first, self.shape, self.pictures = len(backbone.blocks) - count, shape, pictures
        self.pooled = kind.pooled
        wide = {number: width * pictures for number, width in kind.pooled.items()}
        self.kind = replace(kind, pooled=wide)

    def forward(self, pictures: Tensor) -> Tensor:
        """Features (B, F) of rows (B, pictures x numbers), coarsest resolution last."""
        return torch.cat([self._one(row) for row in pictures.chunk(self.pictures, dim=1)], dim=1)

    def _one(self, rows: Tensor) -> Tensor:
        known = rows.shape[1] - int(np.prod(self.shape))
        pooled = [rows[:, :known]]
        x = rows[:, known:].unflatten(1, self.shape).contiguous(memory_format=torch.channels_last)
        for number, block in enumerate(self.blocks, self.first):
            x = block(x)
            if number in self.pooled:
                pooled.append(x.mean(dim=(2, 3)))
        return torch.cat(pooled, dim=1)


@torch.inference_mode()
def first_blocks(
    backbone: Backbone, count: int, pictures: np.ndarray, shift: int, batch: int
) -> tuple[np.ndarray, tuple[int, int, int]]:
    """What all but the last blocks make of images.

    Args:
        count: number of last blocks.
        pictures: (N, H, W, 3) uint8.
        shift: colour shift.
        batch: images at once.

    Returns:
        (N, numbers) float32, the features of the finer resolutions and the input of the last
        blocks; and the shape of that input.
    """
    seen: list[Tensor] = []
    number = len(backbone.blocks) - count
    hook = backbone.blocks[number].register_forward_pre_hook(
        lambda _, inputs: seen.append(inputs[0])
    )
    widths = [width for place, width in backbone.kind.pooled.items() if place < number]
    rows, shape = [], (0, 0, 0)
    for chunk in torch.split(torch.from_numpy(shift_colours(pictures, shift)), batch):
        features = backbone(chunk)[:, : sum(widths)]
        before = seen.pop()
        shape = (before.shape[1], before.shape[2], before.shape[3])
        rows.append(torch.cat([features, before.flatten(1)], dim=1).numpy())
    hook.remove()
    return np.concatenate(rows), shape
