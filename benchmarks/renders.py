"""Finished images per second, compared with a bare pyrender loop over the same scenes.

Both use one thread, like a job; the rate of a renderer on all cores would not apply to a job.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.figures import Figure, rates, seconds

from grasptypes.renders.renderer import Camera, Views
from grasptypes.renders.scene import load_parts
from grasptypes.runtime import pin_runtime
from grasptypes.settings.params import Params


def measure(settings: Mapping[str, Any], params: Params) -> Iterator[Figure]:
    """Ours end as PNG files with ground and shadow; the bare loop's are arrays."""
    pin_runtime()
    taken_s = []
    with Camera(params.renders) as camera:
        for name in settings["objects"]:
            parts = load_parts(Path("data/objects") / name / "visual.glb")
            views = camera.views(parts, settings["views"], name, seed=0)
            works = partial(_finish, views), partial(_draw, camera, parts, views)
            taken_s.append(seconds(*works, rounds=settings["rounds"]))
    done = settings["views"] * len(taken_s)
    yield rates(f"renders through {camera.platform}", "pictures/s", np.sum(taken_s, axis=0), done)


def _finish(views: Views) -> None:
    for _ in views.pngs():
        pass


def _draw(camera: Camera, parts: Any, views: Views) -> None:
    scene, node, _ = camera.scene(parts)
    for pose in views.T_object_camera:
        scene.set_pose(node, pose)
        camera.shoot(scene)
