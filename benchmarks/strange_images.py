"""Images that show no known kind: drawn textures, and what installed packages ship.

scikit-learn and Matplotlib ship a few images; scikit-image, if it is installed, many more.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

from grasptypes.seeds import rng

SIZE = 224
TEXTURES = ("brick", "grass", "gravel", "text", "page", "moon", "ihc", "cell", "coins")
SCENES = {
    "sklearn": ("datasets/images/china.jpg", "datasets/images/flower.jpg"),
    "skimage": tuple(
        f"data/{name}"
        for name in ("rocket.jpg", "motorcycle_left.png", "camera.png", "chelsea.png")
    ),
}
# Upper left corner and size of a face in a photograph of a person.
FACES = {
    "matplotlib": ("mpl-data/sample_data/grace_hopper.jpg", (80, 50, 360)),
    "skimage": ("data/astronaut.png", (110, 0, 230)),
}
CROPS = 8  # of each image


def groups() -> dict[str, np.ndarray]:
    """Images (N, 224, 224, 3) uint8 of each group that there is something of."""
    textures = [f"data/{name}.png" for name in TEXTURES]
    found = {
        "drawn textures": list(_drawn()),
        "textures": [crop for path in _files("skimage", textures) for crop in _crops(path, 0.4)],
        "scenes": [
            crop
            for package, names in SCENES.items()
            for path in _files(package, names)
            for crop in _crops(path, 0.5)
        ],
        "faces": list(_faces()),
    }
    return {name: np.stack(pictures) for name, pictures in found.items() if pictures}


def _files(package: str, names: tuple[str, ...] | list[str]) -> list[Path]:
    found = importlib.util.find_spec(package)
    if found is None or found.origin is None:
        return []
    return [Path(found.origin).parent / name for name in names]


def _crops(path: Path, least: float) -> Iterator[np.ndarray]:
    """Random squares of an image, whose sides are at least a share of its shorter side."""
    image, draw = Image.open(path).convert("RGB"), rng("strange image", path.name)
    for _ in range(CROPS):
        side = int(draw.uniform(least, 1) * min(image.size))
        left, top = (int(draw.integers(0, length - side + 1)) for length in image.size)
        yield _sized(image.crop((left, top, left + side, top + side)))


def _faces() -> Iterator[np.ndarray]:
    for package, (name, (left, top, side)) in FACES.items():
        for path in _files(package, [name]):
            yield _sized(Image.open(path).convert("RGB").crop((left, top, left + side, top + side)))
    for path in _files("skimage", ["data/lfw_subset.npy"]):  # 100 faces, then other things
        for face in np.load(path)[:100]:
            yield _sized(Image.fromarray((255 * face).astype(np.uint8)).convert("RGB"))


def _sized(image: Image.Image) -> np.ndarray:
    return np.asarray(image.resize((SIZE, SIZE), Image.Resampling.BICUBIC))


def _drawn() -> Iterator[np.ndarray]:
    """Noise, stripes, checks and mosaics."""
    rows, columns = np.indices((SIZE, SIZE)) / SIZE
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(SIZE), np.fft.fftfreq(SIZE)))
    frequency[0, 0] = 1
    for number in range(24):
        draw = rng("drawn texture", number)
        noise = np.fft.fft2(draw.normal(size=(3, SIZE, SIZE))) / frequency ** (number / 12)
        levels = np.fft.ifft2(noise).real.transpose(1, 2, 0)
        levels = (levels - levels.min()) / np.ptp(levels)
        yield (255 * levels).astype(np.uint8)
        angle, periods = draw.uniform(0, np.pi), draw.uniform(3, 40)
        along, across = np.cos(angle), np.sin(angle)
        first = np.sin(2 * np.pi * periods * (along * columns + across * rows))
        second = np.sin(2 * np.pi * periods * (along * rows - across * columns))
        colours = draw.integers(0, 256, (2, 3), dtype=np.uint8)
        yield colours[(first * (second if number % 2 else 1) > 0).astype(int)]
        points = draw.random((int(draw.integers(20, 300)), 2))
        places = np.stack([columns, rows], axis=-1).reshape(-1, 2)
        colours = draw.integers(0, 256, (len(points), 3), dtype=np.uint8)
        yield colours[cKDTree(points).query(places)[1]].reshape(SIZE, SIZE, 3)
