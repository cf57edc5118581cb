"""What a user shows - photographs, a mesh, points, an object - as images that predictors see."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from grasptypes.errors import InputError
from grasptypes.objects.file_formats import MESHES, POINTS
from grasptypes.renders import depth_images as depths
from grasptypes.renders.foreground import doubts
from grasptypes.renders.image_parts import box_of, check_box, check_mask, cut, read_mask, reduced
from grasptypes.renders.photos import Box, is_turned, padded, read_whole
from grasptypes.settings.params import Params

if TYPE_CHECKING:
    from grasptypes.objects.object_geometry import ObjectGeometry

Photo = str | Path | np.ndarray


@dataclass(frozen=True)
class Shown:
    """What is known of one object from what was shown.

    Attributes:
        pictures: images (S, S, 3) uint8 of any sizes.
        size_m: lengths, longest first, if they were seen.
        warnings: what is doubtful.
    """

    pictures: tuple[np.ndarray, ...]
    size_m: tuple[float, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Hints:
    """What a user says of an image, or of the file of a mesh or of points.

    Attributes:
        unit: of a mesh or of points.
        background: RGB colour behind transparent pixels.
        box: left, top, right and bottom of the part that shows the object.
        mask: image file, or (H, W) bool: True where the object is.
        depth: depth image as a file, or (H, W) metres, NaN where there is none.
        intrinsics: file, or intrinsics of the camera.
    """

    unit: str | None = None
    background: tuple[int, int, int] | None = None
    box: Box | None = None
    mask: str | Path | np.ndarray | None = None
    depth: str | Path | np.ndarray | None = None
    intrinsics: str | Path | depths.Intrinsics | None = None

    @property
    def of_image(self) -> str:
        """The first option given that only images have; empty if there is none."""
        options = ("background", "box", "mask", "depth", "intrinsics")
        return next((f"--{name}" for name in options if getattr(self, name) is not None), "")


def is_photo(what: object) -> bool:
    """Whether something is taken for images: arrays, and files that are no meshes or points."""
    if isinstance(what, str | Path):
        return Path(what).suffix.lower() not in {*MESHES, *POINTS}
    return isinstance(what, np.ndarray)


def look(what: ObjectGeometry | Photo | Sequence[Photo], hints: Hints, params: Params) -> Shown:
    """See one object.

    Args:
        what: an object; the file of a mesh, of points or of an image; an image (H, W, 3) uint8; or
            several images of the same object.
        params: how meshes are rendered, and what is accepted.

    Raises:
        InputError: a file cannot be used, or hints do not suit it or one another.
    """
    if isinstance(what, Sequence) and not isinstance(what, str):
        return together([look(one, hints, params) for one in what])
    if isinstance(what, np.ndarray) or (isinstance(what, str | Path) and is_photo(what)):
        return _photo(what, hints, params)
    # Photographs need nothing of what is imported here, and are answered sooner without it.
    from grasptypes.predictors.shown_shapes import look_at_file, look_at_object

    if not isinstance(what, str | Path):
        return look_at_object(what, params)
    if hints.of_image:
        message = f"is for images; {Path(what).name} is a mesh or points"
        raise InputError(hints.of_image, "", message)
    return look_at_file(Path(what), hints.unit or "m", params)


def together(parts: Sequence[Shown]) -> Shown:
    """Several looks at the same object; the first size that was seen holds."""
    if not parts:
        raise InputError("images", "", "there are none")
    sizes = [part.size_m for part in parts if part.size_m]
    return Shown(
        tuple(picture for part in parts for picture in part.pictures),
        sizes[0] if sizes else (),
        tuple(dict.fromkeys(text for part in parts for text in part.warnings)),
    )


def _photo(what: Photo, hints: Hints, params: Params) -> Shown:
    settings, limits = params.predict, params.predict.photos
    if hints.unit is not None:
        raise InputError("--unit", hints.unit, "is for meshes and points: an image has no unit")
    if isinstance(what, np.ndarray):
        whole = _checked(what)
        if whole.ndim == 4:
            return together([_photo(one, hints, params) for one in whole])
    else:
        whole = read_whole(what, limits, hints.background)
    region, box = _part(whole.shape[:2], hints, params)
    size_m: tuple[float, ...] = ()
    if hints.depth is not None or hints.intrinsics is not None:
        if not isinstance(what, np.ndarray) and is_turned(what, limits):
            raise InputError(
                what, "", "is turned by its metadata, but --depth is not: save it upright"
            )
        size_m = (_measured(whole.shape[:2], region, box, hints, params),)
    part = reduced(whole if box is None else cut(whole, box), limits.reduce_px)
    return Shown((padded(part),), size_m, () if box else doubts(whole, settings.foreground))


def _checked(pictures: np.ndarray) -> np.ndarray:
    """An image or images with 8 bits per colour."""
    if pictures.dtype != np.uint8 or pictures.ndim not in (3, 4) or pictures.shape[-1] != 3:
        said = f"{pictures.dtype} of shape {pictures.shape}"
        raise InputError("image", "", f"is {said}; needed: uint8 of shape (height, width, 3)")
    if 0 in pictures.shape:
        raise InputError("image", "", f"is empty: it has shape {pictures.shape}")
    return pictures


def _part(
    shape: tuple[int, int], hints: Hints, params: Params
) -> tuple[np.ndarray | None, Box | None]:
    """The mask, if there is one, and the box around the object."""
    if hints.box is not None and hints.mask is not None:
        raise InputError("--box", "", "has no effect beside --mask: give one of them")
    if hints.box is not None:
        check_box(hints.box, shape, params.predict.photos.min_px)
        return None, hints.box
    if hints.mask is None:
        return None, None
    file: str | Path = "--mask"
    if isinstance(hints.mask, np.ndarray):
        mask = hints.mask > 0
    else:
        file, mask = hints.mask, read_mask(hints.mask, params.predict.photos)
    check_mask(mask, shape, file)
    box = box_of(mask)
    check_box(box, shape, params.predict.photos.min_px, file)
    return mask, box


def _measured(
    shape: tuple[int, int], region: np.ndarray | None, box: Box | None, hints: Hints, params: Params
) -> float:
    """The longest extent of the object in metres, from the depth image."""
    if hints.depth is None:
        raise InputError("--intrinsics", "", "is for depth images: name one with --depth")
    if hints.intrinsics is None:
        raise InputError("--depth", "", "needs --intrinsics: a JSON file with fx, fy, cx and cy")
    if box is None:
        raise InputError("--depth", "", "needs --mask or --box, which say where the object is")
    limits, photos = params.predict.depth, params.predict.photos
    file, camera_file = "--depth", "--intrinsics"
    if isinstance(hints.depth, np.ndarray):
        depth = hints.depth
    else:
        file, depth = str(hints.depth), depths.read_depth(hints.depth, photos)
    if isinstance(hints.intrinsics, depths.Intrinsics):
        camera = hints.intrinsics
    else:
        camera_file, camera = str(hints.intrinsics), depths.read_intrinsics(hints.intrinsics)
    depths.check_camera(camera, camera_file, depth, shape)
    if region is None:
        region = depths.standing_in(depth, box, limits, file)
    found = depths.longest_extent(depth, region, camera, limits, file)
    low, high = params.predict.size_m
    if not low <= found <= high:
        message = f"the object measures {found:.4g} m; must be {low:g} to {high:g} m"
        raise InputError(file, "", message)
    return found
