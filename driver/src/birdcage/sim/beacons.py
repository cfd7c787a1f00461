"""What a simulated receiver can hear: beacons as data, each with its way over the sky.

A JSON file:

    {"beacons": [{"name": "DEMO LEO 1", "frequency_hz": 11.7e9,
                  "rows": [[1763748000.0, 181.2, 10.0, -44.0, 251000.0], ...]}]}

A row is POSIX seconds, true azimuth and elevation in degrees, the level in dB at the centre of the beam, and by how
many hertz its frequency is shifted there (left out: 0). Rows are in the order of time, 30 s apart at most where it is
up.
"""

from __future__ import annotations

import bisect
import itertools
import json
import math
from dataclasses import dataclass
from pathlib import Path

from birdcage.base.geometry import wrap_360

GAP_S = 30.0
"""Rows further apart than this are two passes: nothing is heard between them."""
NUMBERS = (4, 5)
"""Of a row."""


@dataclass(frozen=True, slots=True)
class BeaconHeard:
    """A beacon at one moment."""

    az_deg: float
    el_deg: float
    level_db: float
    frequency_hz: float
    """As it arrives."""


@dataclass(frozen=True, slots=True)
class Beacon:
    """One of them. `times_s` and `rows` go together."""

    name: str
    frequency_hz: float
    times_s: tuple[float, ...]
    rows: tuple[BeaconHeard, ...]

    def at(self, time_s: float) -> BeaconHeard | None:
        """Return it at that time; None if it is not up."""
        after = bisect.bisect_left(self.times_s, time_s)
        if after < len(self.rows) and self.times_s[after] == time_s:
            return self.rows[after]
        if after in (0, len(self.rows)) or self.times_s[after] - self.times_s[after - 1] > GAP_S:
            return None
        before_s, after_s = self.times_s[after - 1], self.times_s[after]
        return _between(self.rows[after - 1], self.rows[after], (time_s - before_s) / (after_s - before_s))


def _between(one: BeaconHeard, other: BeaconHeard, part: float) -> BeaconHeard:
    """Return what lies between: the direction as a vector, since azimuths run away near the zenith."""
    east, north, up = (
        a + (b - a) * part
        for a, b in zip(_vector(one.az_deg, one.el_deg), _vector(other.az_deg, other.el_deg), strict=True)
    )
    return BeaconHeard(
        wrap_360(math.degrees(math.atan2(east, north))),
        math.degrees(math.atan2(up, math.hypot(east, north))),
        one.level_db + (other.level_db - one.level_db) * part,
        one.frequency_hz + (other.frequency_hz - one.frequency_hz) * part,
    )


def _vector(az_deg: float, el_deg: float) -> tuple[float, float, float]:
    az, el = math.radians(az_deg), math.radians(el_deg)
    return math.sin(az) * math.cos(el), math.cos(az) * math.cos(el), math.sin(el)


def read_beacons(path: Path) -> tuple[Beacon, ...]:
    """Return the beacons of a file.

    Raises:
        ValueError: it is no such file; the message says where.
        OSError: it cannot be read.

    """
    data = json.loads(path.read_text(encoding="utf-8"))
    listed = data.get("beacons") if isinstance(data, dict) else None
    if not isinstance(listed, list):
        raise ValueError(f"{path}: beacons are a list under the key `beacons`")
    return tuple(_beacon(each, f"{path}, beacon {number}") for number, each in enumerate(listed, 1))


def _beacon(data: object, where: str) -> Beacon:
    if not isinstance(data, dict) or not isinstance(data.get("rows"), list):
        raise ValueError(f"{where}: it needs a name, frequency_hz, and rows")
    frequency_hz = _number(data.get("frequency_hz"), where)
    rows = []
    for row in data["rows"]:
        if not isinstance(row, list) or len(row) not in NUMBERS:
            raise ValueError(f"{where}: a row is time, azimuth, elevation, level, and perhaps the shift")
        rows.append([_number(each, where) for each in row] + [0.0] * (max(NUMBERS) - len(row)))
    times_s = tuple(row[0] for row in rows)
    if any(later <= earlier for earlier, later in itertools.pairwise(times_s)):
        raise ValueError(f"{where}: its rows are not in the order of time")
    heard = tuple(BeaconHeard(az, el, level, frequency_hz + shift) for _, az, el, level, shift in rows)
    return Beacon(str(data.get("name", "")), frequency_hz, times_s, heard)


def _number(value: object, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"{where}: {value!r} is no number")
    return float(value)
