"""Show how grasps hold: one that holds and one that is lost as animations, and the worst ones."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from grasptypes.files import write_bytes
from grasptypes.hands.hand import Hand
from grasptypes.hands.reading import load_hand
from grasptypes.hands.states import HandStates
from grasptypes.jobs import job
from grasptypes.labels.dataset import dataset_schema
from grasptypes.labels.recorded import RecordedGrasp, recorded_grasp
from grasptypes.objects.object_geometry import read_object
from grasptypes.physics.engines import engine
from grasptypes.renders.contact_pictures import plain
from grasptypes.renders.gallery import grasp_picture
from grasptypes.renders.grasp_film import film, gif_bytes
from grasptypes.renders.renderer import Camera, png_bytes
from grasptypes.renders.scene import load_parts
from grasptypes.reports.sheets import Group, Tile, sheet
from grasptypes.robustness.playing import (
    Frame,
    displacement,
    lost_grasps,
    most_robust,
    play,
    withstands,
    worst,
)
from grasptypes.robustness.tables import ROBUSTNESS_SCHEMA
from grasptypes.settings.physics import PhysicsSettings
from grasptypes.settings.renders import CameraSettings, GallerySettings
from grasptypes.settings.robustness import FilmSettings
from grasptypes.tables import read_table

KEYS = ["Object", "Intent", "Session"]


class Stage(NamedTuple):
    """What films are made with."""

    hand: Hand
    objects: Path
    physics: PhysicsSettings
    film: FilmSettings
    gallery: GallerySettings


class Scene(NamedTuple):
    """A grasp as it plays."""

    test: pd.Series
    grasp: RecordedGrasp
    frames: list[Frame]


def scene(stage: Stage, test: pd.Series, grasp: RecordedGrasp) -> Scene:
    """Play a grasp in the engine that is shown."""
    geometry, how = read_object(stage.objects / test.Object), stage.film
    with engine(how.engine, stage.hand, geometry, stage.physics) as world:
        frames = list(play(world, grasp, how.frame_s, how.direction_s, how.lost_m))
    return Scene(test, grasp, frames)


def film_bytes(stage: Stage, camera: Camera, shown: Scene) -> bytes:
    """An animation of a grasp."""
    test, grasp, frames = shown
    how, T = stage.film, grasp.T_object_touching
    parts = load_parts(read_object(stage.objects / test.Object).visual)
    pictures = film(parts, stage.hand, T, frames, camera, stage.gallery.elevation_rad)
    name = f"{test.Object}, {test.Intent}"
    captioned = [
        sheet([Group("", [Tile(picture, f"{name}: {frame.happening}")])], 1, len(picture))
        for picture, frame in zip(pictures, frames, strict=True)
    ]
    return gif_bytes(captioned, how.frame_s * how.slower, how.pause_s)


def worst_sheet(stage: Stage, camera: Camera, rows: list[tuple[pd.Series, RecordedGrasp]]) -> Any:
    """The worst grasps with what they withstand."""
    tiles = []
    for test, grasp in rows:
        state = HandStates(stage.hand, grasp.T_object_held[None], grasp.held_positions[None])
        parts = load_parts(read_object(stage.objects / test.Object).visual)
        picture = grasp_picture(parts, state, camera, stage.gallery.elevation_rad)
        name = f"{test.Object}, {test.Intent}, session {test.Session}"
        tiles.append(Tile(picture, f"{name}\n{withstands(test)}"))
    return sheet([Group("", tiles)], stage.film.worst_columns, stage.gallery.size_px)


def film_grasps(
    dataset: str, tests_path: str, stage: Stage, outputs: Mapping[str, str], renders: CameraSettings
) -> None:
    """Write the animations and the sheet."""
    tests = read_table(tests_path, ROBUSTNESS_SCHEMA)
    rows = read_table(dataset, dataset_schema(stage.hand)).set_index(KEYS)

    def recorded(test: pd.Series) -> RecordedGrasp:
        return recorded_grasp(rows.loc[tuple(test[KEYS])], stage.hand)

    def played(index: int) -> Scene:
        return scene(stage, tests.loc[index], recorded(tests.loc[index]))

    held, lost = played(most_robust(tests)), None
    for index in lost_grasps(tests, stage.film.engine):
        lost = played(index)
        # Some objects only turn between the fingers; one that falls is easier to see.
        if displacement(lost.frames) > stage.film.lost_m:
            break
    with Camera(plain(renders, stage.gallery.size_px)) as camera:
        write_bytes(outputs["held"], film_bytes(stage, camera, held))
        write_bytes(outputs["lost"], film_bytes(stage, camera, lost or held))
        chosen = [
            (test, recorded(test)) for _, test in worst(tests, stage.film.worst).iterrows()
        ]  # fmt: skip
        picture = worst_sheet(stage, camera, chosen)
    write_bytes(outputs["worst"], png_bytes(picture, renders.png_compression))


if __name__ == "__main__":
    with job(snakemake.log):
        params = snakemake.params
        film_grasps(
            snakemake.input.grasps,
            snakemake.input.tests,
            Stage(
                load_hand(params.hand["name"]),
                Path("data/objects"),
                PhysicsSettings.check(params.physics),
                FilmSettings.check(params.film),
                GallerySettings.check(params.gallery),
            ),
            snakemake.output,
            CameraSettings.check(params.renders),
        )
