"""Extract features of renders of an object's variants; nothing else of them is kept."""

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import torch

from grasptypes.files import write_npz
from grasptypes.jobs import job
from grasptypes.kinds.variation import build_variant
from grasptypes.objects.parts import ImportedModel
from grasptypes.objects.preparation import visual_glb
from grasptypes.objects.variants import variant_names
from grasptypes.predictors.backbone import load_backbone
from grasptypes.predictors.features import encodings, extract
from grasptypes.predictors.weights import BackboneRecord
from grasptypes.renders.renderer import Camera
from grasptypes.renders.scene import Part, load_parts
from grasptypes.settings.objects import VariationRanges
from grasptypes.settings.renders import CameraSettings


def variant_parts(name: str, objects: Mapping[str, Any], seed: int) -> list[Part]:
    """The visible parts of a variant; `objects` is the section of params.yaml."""
    model = build_variant(name, VariationRanges.check(objects["variation"]), seed)
    sized = ImportedModel(model, objects["scale"])
    content = visual_glb(sized, objects["resolution"]["crease_deg"])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "visual.glb"
        path.write_bytes(content)
        return load_parts(path)


def picture_variants(
    record: str, target: str, name: str, settings: Mapping[str, Any], seed: int
) -> None:
    """Write one array per variant and encoding, (views, F) float32, named `mug_v01/use`."""
    known = BackboneRecord.read(record)
    backbone = load_backbone(known.find_weights(), known.input_px)
    shifts, chosen = encodings(settings["tasks"]), settings["features"]
    features = {}
    with Camera(CameraSettings.check(settings["renders"])) as camera:
        names = variant_names(name, len(settings["views"]))
        for variant, count in zip(names, settings["views"], strict=True):
            parts = variant_parts(variant, settings["objects"], seed)
            views = camera.views(parts, count, variant, seed)
            pictures = np.stack(list(views.pictures()))
            found = extract(backbone, pictures, shifts, chosen["precision"], chosen["batch"])
            features |= {f"{variant}/{encoding}": array for encoding, array in found.items()}
    write_npz(target, features)


if __name__ == "__main__":
    with job(snakemake.log):
        torch.set_num_threads(snakemake.threads)
        picture_variants(
            snakemake.input.backbone,
            snakemake.output.features,
            snakemake.wildcards.object,
            snakemake.params.settings,
            snakemake.params.seed,
        )
