"""Element sets for the tests of the pass search, and the search by brute force that it is held against."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import posix_s
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track
from sgp4.api import Satrec

START = datetime(2026, 9, 20, 6, tzinfo=UTC)


@dataclass(frozen=True)
class Seen:
    """A pass as brute force finds it: POSIX seconds, degrees."""

    aos_s: float
    los_s: float
    max_elevation_deg: float


def element_set(name: str, line1: str, line2: str) -> ElementSet:
    record = Satrec.twoline2rv(line1, line2)
    return ElementSet(
        name=name,
        norad_id=record.satnum,
        epoch=datetime(1949, 12, 31, tzinfo=UTC)
        + timedelta(days=record.jdsatepoch - 2433281.5)
        + timedelta(days=record.jdsatepochF),
        inclination_deg=math.degrees(record.inclo),
        raan_deg=math.degrees(record.nodeo),
        eccentricity=record.ecco,
        argument_of_perigee_deg=math.degrees(record.argpo),
        mean_anomaly_deg=math.degrees(record.mo),
        mean_motion_rev_day=record.no_kozai * 720.0 / math.pi,
        bstar=record.bstar,
    )


def made_up(count: int, seed: int) -> list[ElementSet]:
    """Orbits of every kind: half of them low, then navigation, Molniya, transfer and geostationary orbits."""
    dice = random.Random(seed)
    kinds: list[Callable[[], tuple[float, float, float]]] = [
        lambda: (dice.uniform(13.0, 16.0), dice.uniform(0.0, 0.01), dice.uniform(0.0, 110.0)),
        lambda: (dice.uniform(1.9, 2.2), dice.uniform(0.0, 0.02), dice.uniform(50.0, 66.0)),
        lambda: (dice.uniform(1.95, 2.05), dice.uniform(0.6, 0.75), dice.uniform(61.0, 65.0)),
        lambda: (dice.uniform(2.0, 6.0), dice.uniform(0.3, 0.72), dice.uniform(0.0, 98.0)),
        lambda: (1.0027, dice.uniform(0.0, 0.003), dice.uniform(0.0, 15.0)),
    ]
    elements = []
    for number in range(count):
        motion, eccentricity, inclination = kinds[0 if number % 2 else dice.randrange(1, len(kinds))]()
        semi_major_km = (398600.8 * (86400.0 / motion / (2.0 * math.pi)) ** 2) ** (1.0 / 3.0)
        eccentricity = max(0.0, min(eccentricity, 1.0 - 6650.0 / semi_major_km))
        where = [dice.uniform(0.0, 360.0) for _ in range(3)]
        elements.append(
            ElementSet(
                f"MADE UP {number}", number + 1, START - timedelta(hours=dice.uniform(0.0, 48.0)), inclination,
                where[0], eccentricity, where[1], where[2], motion, dice.uniform(0.0, 1e-4),
            )
        )  # fmt: skip
    return elements


def brute(
    elements: ElementSet, observer: Observer, start: datetime, hours: float, mask_deg: float,
    offset_s: float = 0.0, grid_s: float = 10.0,
) -> list[Seen]:  # fmt: skip
    """Every pass, by SGP4 every few seconds, golden section at every maximum and bisection at every crossing."""
    begin = posix_s(start)
    end = begin + hours * 3600.0

    def elevation(t: np.ndarray) -> np.ndarray:
        return track(elements, observer, t, offset_s).el_deg if len(t) else np.empty(0)

    t = np.append(np.arange(begin, end, grid_s), end)
    el = elevation(t)
    inner = np.flatnonzero((el[1:-1] > el[:-2]) & (el[1:-1] >= el[2:]) & (el[1:-1] > mask_deg - 5.0)) + 1
    # The first and the last stretch may hold a maximum that no point of the grid tells of.
    low, high = np.append(t[inner - 1], (t[0], t[-2])), np.append(t[inner + 1], (t[1], t[-1]))
    for _ in range(32):
        third = (high - low) * 0.382
        rises = elevation(low + third) < elevation(high - third)
        low, high = np.where(rises, low + third, low), np.where(rises, high, high - third)
    peaks = 0.5 * (low + high)
    t = np.sort(np.concatenate((t, peaks)))
    el = elevation(t)
    up = el > mask_deg
    at = np.flatnonzero(up[1:] != up[:-1])
    low, high, rising = t[at], t[at + 1], up[at + 1]
    for _ in range(34):
        middle = 0.5 * (low + high)
        before = (elevation(middle) > mask_deg) != rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    roots = 0.5 * (low + high)
    rises = ([begin] if up[0] else []) + list(roots[rising])
    sets = list(roots[~rising]) + ([end] if up[-1] else [])
    return [
        Seen(rise, fall, float(el[(t >= rise) & (t <= fall)].max()))
        for rise, fall in zip(rises, sets, strict=True)
    ]  # fmt: skip


@pytest.fixture
def tle() -> Callable[[str, str, str], ElementSet]:
    return element_set


@pytest.fixture
def orbits() -> Callable[[int, int], list[ElementSet]]:
    return made_up


@pytest.fixture
def start() -> datetime:
    return START


@pytest.fixture
def agree() -> Callable[..., int]:
    """Search, hold every satellite's passes against brute force, and return how many passes there were."""
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet

    def check(
        elements: list[ElementSet], observer: Observer, when: datetime, hours: float, mask_deg: float,
        offsets: dict[int, float] | None = None, grid_s: float = 10.0,
    ) -> int:  # fmt: skip
        table = search(Fleet(elements), observer, when, hours, mask_deg, offsets)
        begin, end = posix_s(when), posix_s(when) + hours * 3600.0
        assert not table.failed
        assert list(table.aos_s) == sorted(table.aos_s)
        for index, one in enumerate(elements):
            found = np.flatnonzero(table.fleet_index == index)
            expected = brute(one, observer, when, hours, mask_deg, (offsets or {}).get(index, 0.0), grid_s)
            told = f"{one.name} over {observer} above {mask_deg}: {expected}"
            assert len(found) == len(expected), told
            for row, seen in zip(found, expected, strict=True):
                assert abs(table.aos_s[row] - seen.aos_s) < 0.002, told
                assert abs(table.los_s[row] - seen.los_s) < 0.002, told
                assert abs(table.max_elevation_deg[row] - seen.max_elevation_deg) < 0.001, told
                assert table.aos_s[row] <= table.tca_s[row] <= table.los_s[row], told
                assert table.already_up[row] == (seen.aos_s == begin), told
                assert table.still_up[row] == (seen.los_s == end), told
        return len(table)

    return check
