"""What a pass heard against elevation: mean, scatter and number of readings, rising and setting apart."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import partial

from birdcage.pursuit.pass_record import PassSample

STEPS_DEG = (1.0, 2.0, 5.0, 10.0)
MOST_BINS = 12
STANDS_DEG = 0.5
"""What stays within this does neither rise nor set."""


class Way(Enum):
    """Where the target goes."""

    RISING = "rising"
    SETTING = "setting"
    STANDING = "standing"


@dataclass(frozen=True, slots=True)
class HeardBin:
    """The readings between two elevations, on one way."""

    way: Way
    low_deg: float
    high_deg: float
    unit: str
    mean: float
    scatter: float | None
    """Standard deviation of one reading; None for fewer than two."""
    n: int


@dataclass(frozen=True, slots=True)
class _Heard:
    """`n` readings with a mean and the sum of squares about it."""

    mean: float
    squares: float
    n: int


def levels_by_elevation(samples: Sequence[PassSample]) -> list[HeardBin]:
    """Return the level by the target's elevation, the highest first; none where nothing was heard."""
    return [each for unit in _units(samples) for each in _bins(samples, unit, partial(_level, unit))]


def snr_by_elevation(samples: Sequence[PassSample]) -> list[HeardBin]:
    """Return the SNR in dB in the same way."""
    return _bins(samples, "dB", lambda one: None if one.snr_db is None else _Heard(one.snr_db, 0.0, 1))


def _units(samples: Sequence[PassSample]) -> list[str]:
    return list(dict.fromkeys(sample.unit for sample in samples if sample.unit is not None))


def _level(unit: str, sample: PassSample) -> _Heard | None:
    """Return the readings that came with a sample; an older log has not counted them: there it is one."""
    n = 1 if sample.signal_n is None else sample.signal_n
    if sample.signal is None or sample.unit != unit or not n:
        return None
    return _Heard(sample.signal, (n - 1) * (sample.signal_scatter or 0.0) ** 2, n)


def _bins(samples: Sequence[PassSample], unit: str, heard: Callable[[PassSample], _Heard | None]) -> list[HeardBin]:
    found = [
        (way, sample.target_el_deg, told)
        for way, sample in _ways(samples)
        if (told := heard(sample)) is not None
    ]  # fmt: skip
    if not found:
        return []
    elevations = [el_deg for _way, el_deg, _told in found]
    span = max(elevations) - min(elevations)
    step = next((each for each in STEPS_DEG if span / each <= MOST_BINS - 1), STEPS_DEG[-1])
    groups: dict[tuple[float, Way], list[_Heard]] = {}
    for way, el_deg, told in found:
        groups.setdefault((math.floor(el_deg / step) * step, way), []).append(told)
    order = list(Way)
    return [
        _bin(way, low_deg, low_deg + step, unit, group)
        for (low_deg, way), group in sorted(groups.items(), key=lambda each: (-each[0][0], order.index(each[0][1])))
    ]


def _bin(way: Way, low_deg: float, high_deg: float, unit: str, group: Sequence[_Heard]) -> HeardBin:
    """Pool: the squares about the common mean are those within each group, and those of the groups' own means."""
    n = sum(each.n for each in group)
    mean = math.fsum(each.n * each.mean for each in group) / n
    squares = math.fsum(each.squares + each.n * (each.mean - mean) ** 2 for each in group)
    return HeardBin(way, low_deg, high_deg, unit, mean, math.sqrt(squares / (n - 1)) if n > 1 else None, n)


def _ways(samples: Sequence[PassSample]) -> Iterator[tuple[Way, PassSample]]:
    """Yield each with its way: by what lies before and after it, as a pass may have been begun in its middle."""
    elevations = [sample.target_el_deg for sample in samples]
    stands = bool(elevations) and max(elevations) - min(elevations) < STANDS_DEG
    for index, sample in enumerate(samples):
        before, after = elevations[max(index - 1, 0)], elevations[min(index + 1, len(elevations) - 1)]
        yield Way.STANDING if stands else Way.RISING if after >= before else Way.SETTING, sample
