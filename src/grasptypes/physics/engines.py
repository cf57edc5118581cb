"""The physics engines by name. Each is imported when it is used."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import get_args

from grasptypes.hands.hand import Hand
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engine import Engine
from grasptypes.settings.physics import EngineName, PhysicsSettings

ENGINES: tuple[EngineName, ...] = get_args(EngineName)


def check_engines(names: Sequence[EngineName]) -> None:
    """Import the libraries of engines, so that a missing one shows before work starts.

    Raises:
        ModuleNotFoundError: a library is not installed.
    """
    for name in names:
        import_module(name)


@contextmanager
def engine(
    name: EngineName, hand: Hand, geometry: ObjectGeometry, settings: PhysicsSettings
) -> Iterator[Engine]:
    """An engine for one hand and object, in this process, without a window."""
    if name == "mujoco":
        from grasptypes.physics.mujoco_engine import MujocoEngine

        yield MujocoEngine(hand, geometry, settings)
        return
    from grasptypes.physics.bullet_engine import bullet_engine

    with bullet_engine(hand, geometry, settings) as bullet:
        yield bullet
