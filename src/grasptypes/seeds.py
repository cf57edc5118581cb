"""Random numbers that depend on what is computed, not on the order or number of jobs."""

from __future__ import annotations

import hashlib

import numpy as np


def seed(*key: str | int) -> int:
    """A 63-bit seed from the words that name a computation, e.g. ``("contact_map", "mug", 3)``."""
    text = "\x1f".join(f"{type(part).__name__}:{part}" for part in key)
    digest = hashlib.sha256(text.encode()).digest()
    return int.from_bytes(digest[:8], "big") >> 1


def rng(*key: str | int) -> np.random.Generator:
    """A random generator for the computation named by ``key``."""
    return np.random.Generator(np.random.PCG64(seed(*key)))
