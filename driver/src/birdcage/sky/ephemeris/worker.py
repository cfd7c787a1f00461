"""skyfield, kept ready: its ephemeris, its times with our UT1, and places on the ground.

The ephemeris is an excerpt of JPL's DE421 (Folkner, Williams and Boggs, IPN Progress Report 42-178, 2009), cut by
`scripts/cut_ephemeris.py`. skyfield's own UT1 is extrapolated from early 2026 on, and 0.17 s off by the end of that
year (held against the IERS's prediction), which is 2.5 arcseconds: `birdcage.sky.dut1` knows better.
"""

from __future__ import annotations

from datetime import UTC, datetime
from functools import cache, lru_cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.sky.dut1 import dut1_s

if TYPE_CHECKING:
    from birdcage.sky.observer import Observer

FIRST = datetime(2020, 1, 2, tzinfo=UTC)
LAST = datetime(2053, 10, 8, tzinfo=UTC)
"""What the excerpt covers, with room for the light to travel."""


class NotCovered(BirdcageError, ValueError):
    """The ephemeris that ships with birdcage does not reach to that time."""

    reason = Reason.EPHEMERIS


@cache
def ephemeris() -> Any:  # noqa: ANN401 - skyfield has no types
    """Return the ephemeris. It is opened once, and mapped into memory."""
    from skyfield.api import load_file  # type: ignore[import-untyped]

    return load_file(str(files("birdcage.sky") / "data" / "de421_2020_2053.bsp"))


def time_of(when: datetime) -> Any:  # noqa: ANN401 - skyfield has no types
    """Return skyfield's time of an aware time, with UT1 from our table.

    The same object for the same time: it keeps the nutation, which costs most. ValueError for a naive time.
    """
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    return _time_of(when.astimezone(UTC))


@lru_cache(maxsize=32)
def _time_of(when: datetime) -> Any:  # noqa: ANN401 - skyfield has no types
    plain = _timescale(None).from_datetime(when)
    # Delta T is 32.184 s + the leap seconds - DUT1: exchange one DUT1 for the other, to the millisecond.
    return _timescale(round(float(plain.delta_t + plain.dut1) - dut1_s(when), 3)).from_datetime(when)


@lru_cache(maxsize=8)
def _timescale(delta_t_s: float | None) -> Any:  # noqa: ANN401 - skyfield has no types
    """Return a timescale with one Delta T for all times, or with skyfield's own; its built-in tables, no files."""
    from skyfield.api import load

    return load.timescale(delta_t=delta_t_s, builtin=True)


@lru_cache(maxsize=64)
def standpoint(observer: Observer, when: datetime) -> Any:  # noqa: ANN401 - skyfield has no types
    """Return skyfield's observer at a time. NotCovered outside the ephemeris, ValueError for a naive time."""
    from skyfield.api import wgs84

    time = time_of(when)
    if not FIRST <= when <= LAST:
        raise NotCovered(
            f"The ephemeris covers {FIRST:%Y-%m-%d} to {LAST:%Y-%m-%d}: "
            f"where Sun, Moon, planets and stars stand on {when:%Y-%m-%d} is not known."
        )
    place = wgs84.latlon(observer.latitude_deg, observer.longitude_deg, elevation_m=observer.height_m)
    return (ephemeris()["earth"] + place).at(time)
