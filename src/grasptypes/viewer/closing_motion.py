"""How a hand closes onto an object, as a few states between which a page can interpolate."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grasptypes.hands.hand import Hand
from grasptypes.hands.links import Finger

Array = NDArray[np.float64]

# How far the open hand is drawn back along its approach: clear of an object of a hand's width.
RETREAT_M = 0.1


class Motion(NamedTuple):
    """States in order; the last one is the grasp.

    Attributes:
        retreat_m: (k,) how far the hand is back along its approach (-z).
        positions: (k, J) joint positions; rad, prismatic joints m.
    """

    retreat_m: Array
    positions: Array


def closing_motion(hand: Hand, positions: Array) -> Motion:
    """The motion that ends in joint positions (J,).

    The open hand approaches along its palm's normal. Then every finger moves at the rates of its
    description: a joint that the object has stopped stays, and the others go on. Fingers close at
    the same time, although the real hand's need not.
    """
    opened = hand.opened(hand.preshape_of(positions))
    paths = [_finger_path(finger, positions) for finger in hand.fingers]
    longest = max(len(path) for path in paths)
    states = np.tile(opened, (longest, 1))
    for finger, path in zip(hand.fingers, paths, strict=True):
        held = np.concatenate([path, np.tile(path[-1:], (longest - len(path), 1))])
        states[:, list(finger.joints)] = held
    states[-1] = positions
    retreat = np.zeros(len(states) + 1)
    retreat[0] = RETREAT_M
    return Motion(retreat, np.concatenate([opened[None], states]))


def _finger_path(finger: Finger, positions: Array) -> Array:
    """(m + 1, m) positions of a finger's joints: open, and after each of its joints has stopped."""
    goal, now = positions[list(finger.joints)], np.array(finger.open, dtype=np.float64)
    states = [now]
    for place, rates in enumerate(finger.rates):
        time = (goal[place] - now[place]) / rates[place] if rates[place] else 0.0
        now = now + max(time, 0.0) * np.asarray(rates)
        now[: place + 1] = goal[: place + 1]
        states.append(now)
    return np.stack(states)
