"""Orbits in the mixture of a catalogue of today, and a settings folder that holds them. Shared by the benchmarks."""

from __future__ import annotations

import random
from datetime import UTC, datetime, timedelta
from pathlib import Path

from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.elements import ElementSet


def made_up(count: int, start: datetime, seed: int = 5) -> list[ElementSet]:
    """Return orbits of the days before `start`: mostly low, some distant, some eccentric."""
    dice = random.Random(seed)

    def orbit(number: int) -> ElementSet:
        where = dice.random()
        if where < 0.90:
            motion, eccentricity = dice.uniform(13.5, 15.6), dice.uniform(0.0, 0.004)
            inclination = dice.choice((43.0, 53.0, 51.6, 70.0, 86.4, 97.6, 98.2))
        elif where < 0.94:
            motion, eccentricity, inclination = dice.uniform(1.9, 2.2), dice.uniform(0.0, 0.02), 55.5
        elif where < 0.97:
            motion, eccentricity, inclination = dice.uniform(2.0, 6.0), dice.uniform(0.3, 0.74), 63.4
        else:
            motion, eccentricity, inclination = 1.0027, dice.uniform(0.0, 0.001), dice.uniform(0.0, 8.0)
        return ElementSet(
            f"MADE UP {number}", number, start - timedelta(hours=dice.uniform(0.0, 72.0)), inclination,
            dice.uniform(0.0, 360.0), eccentricity, dice.uniform(0.0, 360.0), dice.uniform(0.0, 360.0), motion, 1e-5,
        )  # fmt: skip

    return [orbit(number) for number in range(1, count + 1)]


def fill(home: Path, satellites: int) -> Path:
    """Put so many satellites into a settings folder, twenty of them favourites; return the catalogue."""
    path = Paths.in_folder(home).catalogue
    with Catalogue(path) as catalogue:
        catalogue.add(made_up(satellites, datetime.now(UTC)), group="made up")
        for number in range(1, 21):
            catalogue.set_favourite(number)
    return path
