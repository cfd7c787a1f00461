"""Elements to positions: SGP4, for one satellite over many times or for a whole catalogue at one time."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sgp4.api import SGP4_ERRORS, WGS72, Satrec, SatrecArray  # type: ignore[import-untyped]

from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import Floats, LookArrays, julian, look, posix_s
from birdcage.sky.observer import Observer

Record: TypeAlias = Satrec
"""A satellite as the `sgp4` package keeps it. This module alone talks to that package, which has no types."""
Codes = NDArray[np.uint8]
"""Errors of SGP4; 0 for none."""

_WGS72_EARTH_KM = 6378.135
_SGP4_EPOCH = datetime(1949, 12, 31, tzinfo=UTC)
_REV_DAY_TO_RAD_MIN = 2.0 * math.pi / 1440.0


def satrec(elements: ElementSet) -> Record:
    """Return SGP4's record of these elements (constants of WGS72, improved mode, as the elements are made for).

    Elements that are no orbit make a record whose every position is an error; nothing is raised.
    """
    record = Satrec()
    record.sgp4init(
        WGS72,
        "i",
        0,  # the number plays no part in SGP4, and nine digits do not fit
        (elements.epoch - _SGP4_EPOCH).total_seconds() / 86400.0,
        elements.bstar,
        elements.mean_motion_dot * _REV_DAY_TO_RAD_MIN / 1440.0,
        elements.mean_motion_ddot * _REV_DAY_TO_RAD_MIN / 1440.0**2,
        elements.eccentricity,
        math.radians(elements.argument_of_perigee_deg),
        math.radians(elements.inclination_deg),
        math.radians(elements.mean_anomaly_deg),
        elements.mean_motion_rev_day * _REV_DAY_TO_RAD_MIN,
        math.radians(elements.raan_deg),
    )
    return record


def mean_orbit(record: Record, after_days: float) -> tuple[float, float] | None:
    """Return semi-major axis in km and eccentricity, so long after epoch; None if SGP4 has no orbit left."""
    code, _, _ = record.sgp4_tsince(after_days * 1440.0)
    axis_km = record.am * _WGS72_EARTH_KM
    return None if code or not math.isfinite(axis_km) else (axis_km, record.em)


def sgp4_complaint(code: int) -> str:
    """Return what an error code of SGP4 means, in its own words."""
    return str(SGP4_ERRORS.get(code, "SGP4 gives no position"))


_STATES_A_CALL = 2500
"""SGP4 states that one call works out, some 2 ms: it holds the GIL, and a STOP key would wait for its end."""


def over_grid(records: Sequence[Record], day: Floats, part: Floats) -> tuple[Codes, Floats, Floats]:
    """Return error codes (n, times), TEME positions and velocities (n, times, 3) of satellites that share their times.

    Times as `frames.julian` gives them; km and km/s. A position with an error is not to be used.
    """
    at_once = max(1, _STATES_A_CALL // max(len(day), 1))
    parts = [
        SatrecArray(list(records[begin : begin + at_once])).sgp4(day, part)
        for begin in range(0, max(len(records), 1), at_once)
    ]
    return _joined(parts)


def _joined(parts: Sequence[tuple[Codes, Floats, Floats]]) -> tuple[Codes, Floats, Floats]:
    if len(parts) == 1:
        return parts[0]
    error, r, v = (np.concatenate(some) for some in zip(*parts, strict=True))
    return error, r, v


def over_times(record: Record, day: Floats, part: Floats) -> tuple[Codes, Floats, Floats]:
    """Return error codes (times), TEME positions and velocities (times, 3) of one satellite, as `over_grid` does."""
    error, r, v = record.sgp4_array(day, part)
    return error, r, v


class Fleet(Sequence[ElementSet]):
    """Satellites with their SGP4 records, kept from one question to the next. Not to be changed."""

    def __init__(self, elements: Iterable[ElementSet]) -> None:
        self._elements = tuple(elements)
        self.satrecs: tuple[Record, ...] = tuple(satrec(one) for one in self._elements)
        self._arrays = tuple(
            SatrecArray(list(self.satrecs[begin : begin + _STATES_A_CALL]))
            for begin in range(0, len(self.satrecs), _STATES_A_CALL)
        )

    @overload
    def __getitem__(self, index: int) -> ElementSet: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[ElementSet]: ...
    def __getitem__(self, index: int | slice) -> ElementSet | Sequence[ElementSet]:
        return self._elements[index]

    def __len__(self) -> int:
        return len(self._elements)

    def look(self, observer: Observer, when: datetime, time_offsets: Mapping[int, float] | None = None) -> LookArrays:
        """Return where every satellite stands at one time, in the order of the fleet.

        `time_offsets`: how many seconds later than computed a satellite comes, by its index in the fleet.
        """
        t_s = posix_s(when)
        _, position, velocity = self.states(t_s, time_offsets)
        return look(observer, t_s, position, velocity)

    def states(self, t_s: float, time_offsets: Mapping[int, float] | None = None) -> tuple[Codes, Floats, Floats]:
        """Return SGP4's error codes (n), TEME positions in km and velocities in km/s (n, 3), at POSIX seconds.

        Positions are NaN where there is an error.
        """
        if not self._elements:
            return np.empty(0, np.uint8), np.empty((0, 3)), np.empty((0, 3))
        day, part = julian([t_s])
        errors, positions, velocities = _joined([some.sgp4(day, part) for some in self._arrays])
        error, position, velocity = errors[:, 0], positions[:, 0], velocities[:, 0]
        for index, later_s in (time_offsets or {}).items():
            day, part = julian(t_s - later_s)  # it is now where its elements had it before
            error[index], position[index], velocity[index] = self.satrecs[index].sgp4(float(day), float(part))
        position[error != 0] = np.nan
        return error, position, velocity


@dataclass(frozen=True, slots=True)
class Track(LookArrays):
    """The look angles of one satellite over time."""

    t_s: Floats
    """POSIX seconds, UTC."""
    position_km: Floats
    """TEME, (n, 3)."""
    velocity_km_s: Floats


def track(elements: ElementSet, observer: Observer, times: ArrayLike, time_offset_s: float = 0.0) -> Track:
    """Return one satellite's look angles at `times` (POSIX seconds, in order).

    `time_offset_s`: how much later than computed the satellite comes. NaN where SGP4 has no position.
    """
    t_s = np.atleast_1d(np.asarray(times, dtype=np.float64))
    error, position, velocity = over_times(satrec(elements), *julian(t_s - time_offset_s))
    position[error != 0] = np.nan
    seen = look(observer, t_s, position, velocity)
    return Track(
        az_deg=seen.az_deg,
        el_deg=seen.el_deg,
        range_km=seen.range_km,
        range_rate_km_s=seen.range_rate_km_s,
        t_s=t_s,
        position_km=position,
        velocity_km_s=velocity,
    )
