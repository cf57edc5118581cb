"""Frames a second of our renders beside those of a bare pyrender loop over the same scenes.

python benchmarks/render_speed.py [--views N] [OBJECT ...]
"""

import argparse
import time
from dataclasses import fields
from pathlib import Path

import numpy as np

from grasptypes.params import read_yaml
from grasptypes.renders.renderer import Camera, Studio
from grasptypes.renders.scene import load_parts


def speeds(camera: Camera, visual: Path, views: int, rounds: int) -> tuple[float, float]:
    """Frames a second (finished PNGs, bare loop), medians of rounds that take turns."""
    parts = load_parts(visual)
    ours, bare = [], []
    for number in range(rounds + 1):
        shown = camera.views(parts, views, visual.parent.name, number)
        begun = time.perf_counter()
        count = sum(1 for _ in shown.pngs())
        middle = time.perf_counter()
        scene, node, _ = camera.scene(parts)
        for pose in shown.T_object_camera:
            scene.set_pose(node, pose)
            camera.shoot(scene)
        end = time.perf_counter()
        if number:  # the first round compiles the shaders
            ours.append(count / (middle - begun))
            bare.append(count / (end - middle))
    return float(np.median(ours)), float(np.median(bare))


def main() -> None:
    """Write one line an object and one for all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("objects", nargs="*", help="default: all that are built")
    parser.add_argument("--views", type=int, default=30)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    folder = Path("data/objects")
    names = options.objects or sorted(path.name for path in folder.iterdir())
    renders = read_yaml("params.yaml")["renders"]
    studio = Studio(**{field.name: renders[field.name] for field in fields(Studio)})
    seconds = np.zeros(2)
    with Camera(studio) as camera:
        for name in names:
            pair = speeds(camera, folder / name / "visual.glb", options.views, options.rounds)
            seconds += 1 / np.array(pair)
            line = (
                f"{name:14s} {pair[0]:6.1f} frames/s, bare {pair[1]:6.1f}, {pair[0] / pair[1]:.2f}"
            )
            print(line, flush=True)  # noqa: T201
    total = len(names) / seconds
    summary = f"{'all':14s} {total[0]:6.1f} frames/s, bare {total[1]:6.1f}"
    print(f"{summary}, {total[0] / total[1]:.2f} through {camera.platform}")  # noqa: T201


if __name__ == "__main__":
    main()
