"""Section `kinds`: the shapes of kinds, and their contact sheets."""

from __future__ import annotations

from grasptypes.settings.base import Name, Settings, Unique, setting


class KindSheetSettings(Settings):
    """Contact sheets of kinds."""

    shapes: int = setting("shapes of each kind", ge=1, le=99)
    size_px: int = setting("size at which a shape is rendered", ge=32, le=2048)
    tile_px: int = setting("size of a shape on the sheet", ge=16, le=2048)
    columns: int = setting("kinds side by side", ge=1, le=20)
    azimuth_rad: float = setting("of the camera about z, from x", ge=-6.3, le=6.3)
    elevation_rad: float = setting("of the camera above the horizon", ge=-1.5, le=1.5)


class KindSettings(Settings):
    """Kinds of objects."""

    names: Unique[Name] = setting("kinds of the target `kinds`; an empty list means all")
    shapes: int = setting("shapes of each kind that are grasped", ge=1, le=99)
    sessions: int = setting("sessions per shape and task", ge=1, le=10_000)
    least_grasps: int = setting("valid grasps that make a label", ge=1, le=10_000)
    views: int = setting("images of each shape", ge=1, le=1000)
    sheet: KindSheetSettings
