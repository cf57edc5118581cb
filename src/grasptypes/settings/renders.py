"""Sections `renders`, `gallery` and `contact_pictures`: how images are rendered and laid out."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from grasptypes.settings.base import Many, Settings, Share, Triple, setting


class Light(Settings):
    """A light that moves with the camera."""

    intensity_lux: float = setting("brightness", ge=0, le=100)
    direction: Triple[float] = setting(
        "direction in which the light travels, camera frame (x right, y up, -z forward)"
    )


class RenderSheet(Settings):
    """Sheet that shows all objects."""

    views: int = setting("number of images of each object", ge=1, le=100)
    columns: int = setting("objects side by side", ge=1, le=20)
    tile_px: int = setting("size of an image", ge=16, le=2048)


class CameraSettings(Settings):
    """How an image is taken."""

    size_px: int = setting("height and width of an image", ge=32, le=2048)
    field_of_view_rad: float = setting("full angle of an image", ge=0.05, le=2.5)
    fill: float = setting("share of half the image that the object reaches", ge=0.1, le=1)
    min_distance_radii: float = setting(
        "smallest camera distance, in radii of the object", ge=1.2, le=100
    )
    colour_randomisation: Share = setting("0 keeps the materials' colours, 1 replaces them")
    ambient: Share = setting("ambient light, linear")
    lights: Many[Light] = setting(
        "lights that move with the camera; the first casts the shadow",
        min_length=1,
        max_length=8,
    )
    background_rgb: Triple[Annotated[int, Field(ge=0, le=255)]] = setting(
        "colour of the ground, levels of 255"
    )
    vignette: Share = setting("share by which the ground is darker in the corners")
    ground_elevation_rad: float = setting(
        "angle at which the camera looks down on the ground", ge=0.1, le=1.57
    )
    shadow_strength: Share = setting("share of the light that the deepest shadow removes")
    shadow_softness_px: float = setting("standard deviation of the shadow's blur", ge=0, le=100)
    shadow_fading: float = setting(
        "the highest point casts exp(-fading) of the lowest point's shadow", ge=0, le=100
    )
    shadow_points: int = setting("surface points that cast the shadow", ge=100, le=1000000)
    png_compression: int = setting("zlib level", ge=0, le=9)


class RenderSettings(CameraSettings):
    """Images of the objects."""

    views: int = setting("images of each object", ge=1, le=1000)
    sheet: RenderSheet


class SessionSheet(Settings):
    """Sheets of all grasps of an object."""

    columns: int = setting("images per row", ge=1, le=40)
    tile_px: int = setting("size of an image", ge=32, le=2048)


class GallerySettings(Settings):
    """Images of grasps and their sheets."""

    screenshot_px: int = setting("size of the image of each grasp", ge=32, le=2048)
    size_px: int = setting("size at which grasps are rendered", ge=32, le=2048)
    tile_px: int = setting("size of an image on the sheet", ge=32, le=2048)
    columns: int = setting("images per row of the sheet", ge=1, le=40)
    elevation_rad: float = setting("of the camera above the object's xy plane", ge=-1.5, le=1.5)
    rejected: int = setting("examples of rejected grasps for each reason", ge=1, le=40)
    sessions: SessionSheet


class ContactPictureSettings(Settings):
    """Images of the contact maps."""

    size_px: int = setting("height of an image and width of each of its two views", ge=32, le=2048)
    azimuth_rad: float = setting("of the first camera about z, from x", ge=-6.3, le=6.3)
    elevation_rad: float = setting("of the cameras above the horizon", ge=-1.5, le=1.5)
    edge_m: float = setting("longest edge of the coloured mesh", ge=0.0005, le=1)
    columns: int = setting("images per row of the sheet", ge=1, le=20)
    tile_px: int = setting("height of an image on the sheet", ge=32, le=2048)
