"""What the kinds look like that the predictor for unseen objects has learned from."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from grasptypes.jobs import job
from grasptypes.predictors.general_backbone import weights_of
from grasptypes.predictors.general_files import kind_families, object_families, read_pictures_of
from grasptypes.predictors.general_inputs import joined
from grasptypes.predictors.known_kinds import learn_kinds, write_kinds, write_looks
from grasptypes.renders.mesh_views import views
from grasptypes.settings.commands import KnownKindSettings
from grasptypes.settings.renders import CameraSettings


def know_kinds(
    features: tuple[str, str],
    target: str | Path,
    families: Mapping[str, Sequence[str]],
    settings: tuple[KnownKindSettings, int],
    weights: str,
) -> str:
    """Write what images of kinds and of objects have in common; returns a line for the log."""
    kinds, objects = map(read_pictures_of, features)
    named = object_families(sorted(set(objects.objects.tolist())), families)
    known = learn_kinds(
        joined([kinds, objects]),
        {**kind_families(sorted(set(kinds.objects.tolist()))), **named},
        settings[0],
        weights,
        settings[1],
    )
    write_kinds(known, target)
    return f"{len(known.names)} kinds, limit {known.limit:.3f}"


def draw_kinds(visuals: Sequence[str], target: str | Path, camera: CameraSettings, px: int) -> None:
    """Write a small image of each object; the folder of its mesh has its name."""
    drawn: dict[str, np.ndarray] = {
        Path(visual).parent.name: views(visual, camera, 1)[0] for visual in visuals
    }
    write_looks(drawn, px, target)


if __name__ == "__main__":
    with job(snakemake.log) as log:
        params, given = snakemake.params, snakemake.input
        settings = KnownKindSettings.check(params.settings)
        found = know_kinds(
            (given.kinds, given.objects),
            snakemake.output.known,
            params.families,
            (settings, params.seed),
            weights_of(params.backbone, params.timeout_s).name,
        )
        log.info(found)
        camera = CameraSettings.check(params.camera)
        visuals = [*given.visuals, *given.object_visuals]
        draw_kinds(visuals, snakemake.output.looks, camera, settings.picture_px)
