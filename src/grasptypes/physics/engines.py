"""The physics engines by name. Each is imported when it is used."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import get_args

from grasptypes.hands.hand import Hand
from grasptypes.objects.object_geometry import ObjectGeometry
from grasptypes.physics.engine import Engine
from grasptypes.settings.physics import EngineName, PhysicsSettings

ENGINES: tuple[EngineName, ...] = get_args(EngineName)


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
