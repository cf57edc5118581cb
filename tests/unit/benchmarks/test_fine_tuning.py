"""The last blocks see what the first ones make of an image, as in the whole backbone."""

import numpy as np
import torch
from benchmarks.fine_tuning import LastBlocks, first_blocks

from grasptypes.predictors.backbone import untrained_backbone


def test_first_and_last_blocks_are_the_whole_backbone():
    torch.manual_seed(0)
    backbone = untrained_backbone("mobilenet_v2", 64).eval()
    pictures = np.random.default_rng(0).integers(0, 256, (4, 64, 64, 3), dtype=np.uint8)
    with torch.inference_mode():
        whole = backbone(torch.from_numpy(pictures))
        rows, shape = first_blocks(backbone, 3, pictures, 0, 3)
        one = LastBlocks(backbone, 3, shape).eval()(torch.from_numpy(rows))
        tail = LastBlocks(backbone, 3, shape, 2).eval()
        two = tail(torch.from_numpy(np.hstack([rows, rows[::-1]])))
    assert shape == (160, 2, 2)
    assert torch.allclose(one, whole, atol=1e-5)
    assert torch.allclose(two, torch.cat([whole, whole.flip(0)], dim=1), atol=1e-5)
    assert two.shape[1] == tail.kind.features
    shifted, _ = first_blocks(backbone, 3, pictures, 10, 4)
    assert not np.allclose(shifted, rows)
