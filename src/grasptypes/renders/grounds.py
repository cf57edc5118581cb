"""Procedural grounds behind objects: plain, a gradient, natural noise, stripes and checks."""

from __future__ import annotations

import numpy as np

from grasptypes.settings.general import GroundDraws

# Share of a noise's variation that differs between the colour channels.
CHROMA = 0.12
# How far noise bends stripes and checks, in periods.
BEND = 0.25


def ground(size_px: int, settings: GroundDraws, random: np.random.Generator) -> np.ndarray:
    """A random ground, (size, size, 3) float32, levels of 0 to 255."""
    first, second = (colour(random) for _ in range(2))
    kind = random.random()
    for share, mixed in (
        (settings.gradient, _gradient),
        (settings.noise, _noise),
        (settings.pattern, _pattern),
    ):
        if kind < share:
            levels = mixed(size_px, (first, second), settings, random)
            return np.asarray(np.clip(levels, 0, 255), dtype=np.float32)
        kind -= share
    return np.asarray(np.tile(first, (size_px, size_px, 1)))


def colour(random: np.random.Generator) -> np.ndarray:
    """A random colour (3,) float32: any level of grey, most of them pale."""
    grey = random.uniform(20, 250)
    tint = random.normal(0, 1, 3) * random.exponential(10)
    return np.asarray(np.clip(grey + tint - tint.mean(), 0, 255), dtype=np.float32)


Colours = tuple[np.ndarray, np.ndarray]


def _gradient(
    size_px: int, colours: Colours, _: GroundDraws, random: np.random.Generator
) -> np.ndarray:
    """From one colour to the other along a random direction."""
    across, down = _axes(size_px)
    angle = random.uniform(0, 2 * np.pi)
    along = across * np.cos(angle) + down * np.sin(angle)
    return _mixed(colours, (along - along.min()) / np.ptp(along))


def _noise(
    size_px: int, colours: Colours, settings: GroundDraws, random: np.random.Generator
) -> np.ndarray:
    """Noise about one colour, whose standard deviation is the distance to the other one."""
    exponent = random.uniform(*settings.exponent)
    common, *own = (natural_noise(size_px, exponent, random) for _ in range(4))
    varied = np.stack([(1 - CHROMA) * common + CHROMA * channel for channel in own], axis=-1)
    deviation = np.abs(colours[1] - colours[0]).mean() / 3 + 10
    return np.asarray(colours[0] + deviation * varied)


def _pattern(
    size_px: int, colours: Colours, settings: GroundDraws, random: np.random.Generator
) -> np.ndarray:
    """Stripes or checks, bent by noise, with more or less soft edges."""
    across, down = _axes(size_px)
    angle, periods = random.uniform(0, np.pi), random.uniform(*settings.periods)
    bent = BEND * random.random() * natural_noise(size_px, settings.exponent[1], random)
    right, left = np.cos(angle), np.sin(angle)
    turned = across * right + down * left, down * right - across * left
    waves = [np.sin(2 * np.pi * (periods * along / 2 + bent)) for along in turned]
    wave = waves[0] if random.random() < 0.5 else waves[0] * waves[1]
    share = (1 + np.tanh(random.uniform(0.5, 6) * wave)) / 2
    grain = random.uniform(0, 12) * natural_noise(size_px, settings.exponent[0], random)
    return _mixed(colours, share) + grain[..., None]


def natural_noise(size_px: int, exponent: float, random: np.random.Generator) -> np.ndarray:
    """Noise (size, size) float32 of mean 0 and deviation 1 whose amplitude falls with frequency.

    Natural images have an exponent of about 1 (Field 1987, "Relations between the statistics of
    natural images and the response properties of cortical cells").
    """
    waves = np.fft.rfft2(random.standard_normal((size_px, size_px)))
    frequency = np.hypot(np.fft.fftfreq(size_px)[:, None], np.fft.rfftfreq(size_px)[None, :])
    frequency[0, 0] = np.inf
    noise = np.fft.irfft2(waves * frequency**-exponent, (size_px, size_px))
    return np.asarray(noise / noise.std(), dtype=np.float32)


def _axes(size_px: int) -> np.ndarray:
    """Positions to the right and down, -1 to 1: (2, size, size)."""
    axis = np.linspace(-1, 1, size_px, dtype=np.float32)
    return np.stack(np.meshgrid(axis, axis))


def _mixed(colours: Colours, share: np.ndarray) -> np.ndarray:
    first, second = colours
    return np.asarray(first + share[..., None] * (second - first), dtype=np.float32)
