"""Where a source is while a task listens to it: true directions at times, as any program can tell them to a station."""

from __future__ import annotations

import itertools
import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn, wrap_360
from birdcage.signal.listen import check_number

if TYPE_CHECKING:
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets.model import Target
    from birdcage.tracking.planning.refraction import Refraction

MOST_ROWS = 500
EVERY_S = 30.0
STILL_DEG = 1e-6
Row = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class SourcePath:
    """Rows of POSIX seconds, azimuth and elevation in degrees, in the order of time; one row is a source at rest.

    Between two rows both angles change evenly; before the first and after the last the source stands there.
    """

    rows: Sequence[Row]

    @classmethod
    def of(cls, rows: object) -> SourcePath:
        """Return the path that a task was told. TypeError, which refuses the task, for anything else."""
        if not isinstance(rows, tuple | list) or not 1 <= len(rows) <= MOST_ROWS:
            raise TypeError(f"path is no list of 1 to {MOST_ROWS} rows")
        for row in rows:
            if not isinstance(row, tuple | list) or len(row) != len(("time", "az", "el")):
                raise TypeError(f"a row of the path is {row!r}. Give POSIX seconds, azimuth and elevation")
            check_number("the time of a row", row[0], 0.0, 1e11)
            check_number("the azimuth of a row", row[1], -720.0, 720.0)
            check_number("the elevation of a row", row[2], -90.0, 90.0)
        if any(one[0] >= other[0] for one, other in itertools.pairwise(rows)):
            raise TypeError("the rows of the path are not in the order of time")
        return cls(tuple((row[0], row[1], row[2]) for row in rows))

    @property
    def begin_s(self) -> float:
        """POSIX seconds."""
        return self.rows[0][0]

    @property
    def end_s(self) -> float:
        """POSIX seconds."""
        return self.rows[-1][0]

    def at(self, now_s: float) -> tuple[float, float]:
        """Return azimuth and elevation."""
        after = bisect_right(self.rows, now_s, key=lambda row: row[0])
        if after in (0, len(self.rows)):
            _time, az_deg, el_deg = self.rows[min(after, len(self.rows) - 1)]
            return wrap_360(az_deg), el_deg
        (time_s, az_deg, el_deg), (next_s, next_az_deg, next_el_deg) = self.rows[after - 1 : after + 1]
        part = (now_s - time_s) / (next_s - time_s)
        return wrap_360(az_deg + part * shortest_turn(az_deg, next_az_deg)), el_deg + part * (next_el_deg - el_deg)

    def moves_deg_s(self, now_s: float, over_s: float = 10.0) -> float:
        """Return how fast it moves on the sky."""
        return separation(*self.at(now_s - over_s / 2.0), *self.at(now_s + over_s / 2.0)) / over_s

    def ahead_deg(self, now_s: float, az_deg: float, el_deg: float, at_s: float) -> float:
        """Return how far it has gone beyond a direction by `now_s`, along the way that it goes at `at_s`.

        Negative where it is still to come.
        """
        before, here = self.at(at_s - 5.0), self.at(at_s + 5.0)
        cos = math.cos(math.radians(el_deg))
        way = shortest_turn(before[0], here[0]) * cos, here[1] - before[1]
        length = math.hypot(*way)
        source = self.at(now_s)
        return (
            (shortest_turn(az_deg, source[0]) * cos * way[0] + (source[1] - el_deg) * way[1]) / length
            if length
            else 0.0
        )


def seen_path(
    target: Target, observer: Observer, refraction: Refraction, begin_s: float, length_s: float
) -> SourcePath:
    """Return where a target is from a time on, for so long; a single row for one that stands still on the sky."""
    from birdcage.tracking.planning.refraction import lift_deg

    def look(when: datetime) -> tuple[float, float]:
        seen = target.look(observer, when)
        return seen.az_deg, seen.el_deg + float(lift_deg(seen.el_deg, refraction))

    path = _path(look, begin_s, length_s)
    return (
        path if separation(*path.at(begin_s), *path.at(begin_s + length_s)) > STILL_DEG else SourcePath(path.rows[:1])
    )


def sun_path(observer: Observer, begin_s: float, length_s: float) -> SourcePath:
    """Return where the Sun is, to a hundredth of a degree and without refraction: at once, with no ephemeris."""
    from birdcage.sky.sun import sun

    return _path(lambda when: sun(when, observer.latitude_deg, observer.longitude_deg), begin_s, length_s)


def _path(look: Callable[[datetime], tuple[float, float]], begin_s: float, length_s: float) -> SourcePath:
    steps = min(max(math.ceil(length_s / EVERY_S), 1), MOST_ROWS - 1)
    times_s = [begin_s + length_s * index / steps for index in range(steps + 1)]
    return SourcePath(tuple((time_s, *look(datetime.fromtimestamp(time_s, UTC))) for time_s in times_s))
