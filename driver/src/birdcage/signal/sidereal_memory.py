"""Where a satellite was found by its signal, day after day, and where it will be by that.

An inclined geosynchronous satellite goes the same way over the sky every sidereal day. Each axis is

    c + a1 cos wt + b1 sin wt + a2 cos 2wt + b2 sin 2wt,    w = 2 pi / 86164.0905 s

fitted by least squares with a prior on each coefficient, so that one direction alone tells something already, and the
standard deviation of the prediction says what that is worth (Bayesian linear regression, C. M. Bishop, *Pattern
Recognition and Machine Learning*, 2006).
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.user_file import read_user_file

SIDEREAL_DAY_S = 86164.0905
OLDEST_S = 5.0 * SIDEREAL_DAY_S
"""Older directions are forgotten: the orbit drifts."""
MOST_KEPT = 1000
"""Of one satellite; the oldest are dropped."""
MOST_BYTES = 20_000_000
PRIOR_DEG = (30.0, 5.0, 5.0, 1.0, 1.0)
"""Standard deviations of the coefficients: a wrong first direction, and an inclination of some degrees."""
LEAST_SIGMA_DEG = 0.01
"""The fit of a single direction is no better: the orbit is not as regular as the formula."""
Vector = list[float]


@dataclass(frozen=True, slots=True)
class FoundDirection:
    """Where a satellite was found. Angles in degrees, true; time in POSIX seconds."""

    time_s: float
    az_deg: float
    el_deg: float
    sigma_deg: float
    """Standard deviation on the sky."""


@dataclass(frozen=True, slots=True)
class Prediction:
    """Where it will be."""

    az_deg: float
    el_deg: float
    sigma_deg: float
    """Standard deviation on the sky, of the worse axis."""


class SiderealOrbit:
    """The way of one satellite over the sky, by the directions in which it was found."""

    def __init__(self, found: Sequence[FoundDirection]) -> None:
        """ValueError for none at all."""
        if not found:
            raise ValueError("no direction is known")
        self._last = max(found, key=lambda each: each.time_s)
        self._cos = math.cos(math.radians(self._last.el_deg))
        recent = [each for each in found if each.time_s > self._last.time_s - OLDEST_S]
        normal = [[0.0] * len(PRIOR_DEG) for _ in PRIOR_DEG]
        across, up = [0.0] * len(PRIOR_DEG), [0.0] * len(PRIOR_DEG)
        for index, prior in enumerate(PRIOR_DEG):
            normal[index][index] = 1.0 / prior**2
        for each in recent:
            terms = self._terms(each.time_s)
            weight = 1.0 / max(each.sigma_deg, LEAST_SIGMA_DEG) ** 2
            az_deg, el_deg = self._offset(each)
            for i, one in enumerate(terms):
                across[i] += weight * one * az_deg
                up[i] += weight * one * el_deg
                for j, other in enumerate(terms):
                    normal[i][j] += weight * one * other
        self._covariance = _inverse(normal)
        self._across = _times(self._covariance, across)
        self._up = _times(self._covariance, up)

    def at(self, time_s: float) -> Prediction:
        """Return where it will be."""
        terms = self._terms(time_s)
        across = sum(one * term for one, term in zip(self._across, terms, strict=True))
        up = sum(one * term for one, term in zip(self._up, terms, strict=True))
        variance = sum(one * term for one, term in zip(_times(self._covariance, terms), terms, strict=True))
        az_deg = wrap_360(self._last.az_deg + across / self._cos)
        return Prediction(az_deg, self._last.el_deg + up, math.sqrt(variance))

    def _offset(self, found: FoundDirection) -> tuple[float, float]:
        """Return how far right of the last direction it was, on the sky there, and how far above it."""
        return shortest_turn(self._last.az_deg, found.az_deg) * self._cos, found.el_deg - self._last.el_deg

    def _terms(self, time_s: float) -> Vector:
        angle = 2.0 * math.pi * (time_s - self._last.time_s) / SIDEREAL_DAY_S
        return [1.0, math.cos(angle), math.sin(angle), math.cos(2.0 * angle), math.sin(2.0 * angle)]


class SiderealMemory:
    """What is kept between sessions, in one file: a line of JSON for each direction of each satellite."""

    def __init__(self, path: Path | None) -> None:
        """`path` None: nothing outlives the program."""
        self._path = path
        self._found: dict[str, list[FoundDirection]] = {}
        self._is_read = False

    def of(self, name: str, now_s: float) -> Sequence[FoundDirection]:
        """Return what is known of a satellite, oldest first. StoreError where the file can't be read."""
        self._read()
        return [each for each in self._found.get(name, []) if now_s - OLDEST_S < each.time_s <= now_s]

    def add(self, name: str, found: FoundDirection) -> None:
        """Keep a direction, on the disk when this returns. StoreError if it can't be written: it counts till the end.

        What is too old is left out of the file.
        """
        self._read()
        kept = [each for each in self._found.get(name, []) if each.time_s > found.time_s - OLDEST_S]
        self._found[name] = [*kept, found][-MOST_KEPT:]
        if self._path is None:
            return
        try:
            write_aside_and_rename(self._path, "".join(self._lines(found.time_s)).encode())
        except OSError as error:
            raise StoreError(f"{self._path} can't be written ({error.strerror or error}).") from error

    def _lines(self, now_s: float) -> Iterable[str]:
        for name, directions in self._found.items():
            for each in directions:
                if each.time_s > now_s - OLDEST_S:
                    utc = datetime.fromtimestamp(each.time_s, UTC).isoformat(timespec="milliseconds")
                    row = {"name": name, "utc": utc, "az_deg": each.az_deg, "el_deg": each.el_deg}
                    yield json.dumps({**row, "sigma_deg": each.sigma_deg}) + "\n"

    def _read(self) -> None:
        if self._is_read or self._path is None:
            return
        try:
            text = read_user_file(self._path, MOST_BYTES).decode("utf-8", "replace")
        except FileNotFoundError:
            text = ""
        except OSError as error:
            raise StoreError(f"{self._path} can't be read ({error.strerror or error}).") from error
        self._is_read = True
        for line in text.splitlines():
            read = _direction(line)
            if read is not None:
                self._found.setdefault(read[0], []).append(read[1])
        for directions in self._found.values():
            directions.sort(key=lambda each: each.time_s)


def _direction(line: str) -> tuple[str, FoundDirection] | None:
    """Read one line; None for one that a crash or a hand has damaged: it counts for nothing."""
    try:
        row = json.loads(line)
        utc = datetime.fromisoformat(row["utc"])
        numbers = [float(row[each]) for each in ("az_deg", "el_deg", "sigma_deg")]
        found = FoundDirection(utc.timestamp(), *numbers)
        whole = utc.tzinfo is not None and all(map(math.isfinite, numbers)) and found.sigma_deg > 0.0
        return (str(row["name"]), found) if whole and abs(found.el_deg) <= 90.0 else None
    except (ValueError, TypeError, KeyError):
        return None


def _times(matrix: Sequence[Vector], vector: Vector) -> Vector:
    return [sum(one * other for one, other in zip(row, vector, strict=True)) for row in matrix]


def _inverse(matrix: list[Vector]) -> list[Vector]:
    """Return the inverse of a positive definite matrix, by Gauss and Jordan."""
    size = len(matrix)
    rows = [[*row, *(float(i == j) for j in range(size))] for i, row in enumerate(matrix)]
    for column in range(size):
        pivot = rows[column][column]
        rows[column] = [each / pivot for each in rows[column]]
        for index in range(size):
            if index != column:
                factor = rows[index][column]
                rows[index] = [one - factor * other for one, other in zip(rows[index], rows[column], strict=True)]
    return [row[size:] for row in rows]
