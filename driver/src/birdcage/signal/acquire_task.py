"""Finds a satellite near where it should be: a spiral until the signal stands out, uphill, a peak, and who that is."""

from __future__ import annotations

import math
from collections.abc import Collection, Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median

from birdcage.base.geometry import separation, wrap_360
from birdcage.rotator.feature import LOCK, NETWORK, NO_NETWORK, SNR, TRANSPONDER, Value
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG, BeamFit, HeardDirection, noise_of
from birdcage.signal.ear import Ears, own_tuner
from birdcage.signal.listen import Listening, check_number, check_patterns, listen_at
from birdcage.signal.peak_task import LOST, PeakTask
from birdcage.signal.slots_heard import SlotSeen, patterns_within
from birdcage.station.task import Task
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, ReadFeatures, Step, StepResult, Steps, Wait, WriteFeature

STEP = 0.5
"""Between two directions of the spiral, in widths of the beam."""
FLOOR_AWAY = 2.5
"""The floor is measured so many widths above the arc, or below it where that is beyond the dish's limits."""
FLOOR_READS = 8
OUTSTANDING = 8.0
"""A direction stands out by so many standard deviations of the difference between its level and the floor."""
LEAST_NOISE = 0.3
"""Counts, or decibels: a source that tells in coarse steps has noise that does not show."""
RING, RING_POINTS = 1.35, 6
"""A first sidelobe has its main lobe so many widths away; so many directions are looked at there."""
MAIN_LOBE = 2.5
"""A main lobe rises at least so many times as high as its sidelobe, even where it is only brushed."""
MOST_UPHILL = 8
"""Half-beam steps: a signal that rises on and on is no satellite."""
MOST_RINGS, MOST_DIRECTIONS = 200, 4000
MOST_EL_DEG = 85.0
"""Higher up an azimuth says nothing."""
LOCK_TRIES, LOCK_EVERY_S = 3, 1.0
"""A tuner needs a moment to lock."""
TRANSPONDERS = (16, 15)
"""Tried where it does not lock: one of either polarisation, as the LNB's supply is not always known."""
TOLD_BY = (LOCK, SNR, NETWORK)
IDENTIFIED_BY = (*TOLD_BY, TRANSPONDER)

Climb = Generator[Step, StepResult, HeardDirection]


@dataclass
class AcquireTask(Task):
    """Searches about a predicted true direction, nearest first, and ends in the middle of the first source it finds.

    Angles in degrees. `width_deg` is that of the beam, 0 for an unknown one; `reach_az_deg` and `reach_el_deg` say how
    far the dish may be off, on the sky. `patterns` as for `PeakTask`. `identify`: what this machine can be asked
    about what it hears, out of `IDENTIFIED_BY`, with blanks between. `source` as for `PeakTask`.
    """

    kind = "acquire"
    goes_on = False
    is_unattended = False
    cut_words = "No satellite was found."
    holder: str
    az_deg: float
    el_deg: float
    width_deg: float = 0.0
    reach_az_deg: float = 15.0
    reach_el_deg: float = 5.0
    patterns: tuple[tuple[float, ...], ...] = ((),)
    identify: str = ""
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    _heard: list[HeardDirection] = field(default_factory=list, init=False)
    _of: int = field(default=0, init=False)
    _done: int = field(default=0, init=False)
    _fit: BeamFit | None = field(default=None, init=False)
    _told: dict[str, Value] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no search."""
        check_number("az_deg", self.az_deg, -720.0, 720.0)
        check_number("el_deg", self.el_deg, -10.0, MOST_EL_DEG)
        check_number("width_deg", self.width_deg, 0.0, 60.0)
        check_number("reach_az_deg", self.reach_az_deg, 0.0, 180.0)
        check_number("reach_el_deg", self.reach_el_deg, 0.0, 45.0)
        check_patterns(self.patterns)
        if not isinstance(self.identify, str) or not set(self.identify.split()) <= set(IDENTIFIED_BY):
            raise TypeError(f"identify is {self.identify!r}. Give some of {', '.join(IDENTIFIED_BY)}")
        self._ear = self.ears(self.source)
        columns, rows = self._cells
        if max(columns, rows) > MOST_RINGS or (2 * columns + 1) * (2 * rows + 1) > MOST_DIRECTIONS:
            raise TypeError(f"that are more than {MOST_DIRECTIONS} directions. Search less far")
        self._of = len(list(self._spiral()))

    @property
    def _width(self) -> float:
        return self.width_deg or ASSUMED_WIDTH_DEG

    @property
    def _cells(self) -> tuple[int, int]:
        """How many steps of the spiral there are to each side, and up and down."""
        step = STEP * self._width
        return int(self.reach_az_deg / step), int(self.reach_el_deg / step)

    def _spiral(self) -> Iterator[tuple[float, float]]:
        """Yield directions, ring by ring about the predicted one, as far as the dish may be off."""
        step = STEP * self._width
        columns, rows = self._cells
        yield self._at(0, 0)
        for ring in range(1, max(columns, rows) + 1):
            for x, y in _around(ring):
                if abs(x) <= columns and abs(y) <= rows and abs(self.el_deg + y * step) < MOST_EL_DEG:
                    yield self._at(x * step, y * step)

    def _at(self, right_deg: float, up_deg: float) -> tuple[float, float]:
        el_deg = self.el_deg + up_deg
        return wrap_360(self.az_deg + right_deg / math.cos(math.radians(el_deg))), el_deg

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Have the source read meanwhile."""
        with self._ear.open():
            yield from self._search(now_s, asked=asked)

    def _search(self, now_s: float, *, asked: bool) -> Steps:
        """Measure the floor, search, and peak; go back to the predicted direction where nothing is found."""
        floor = yield from self._floor()
        if floor is None:
            return
        vain: list[HeardDirection] = []
        for az_deg, el_deg in self._spiral():
            self._done += 1
            if any(_is_near(each, az_deg, el_deg, self._width) for each in vain):
                continue  # something warm, which is no satellite, was looked into there
            here = yield from self._listen(az_deg, el_deg)
            if here is None or not self._stands_out(here, floor):
                continue
            top = yield from self._uphill(here)
            top = yield from self._main_lobe(top, floor)
            about = top.az_deg, min(top.el_deg, MOST_EL_DEG)
            peak = PeakTask(self.holder, *about, self.width_deg, self.patterns, True, ears=lambda _source: self._ear)
            yield from peak.steps(now_s, asked=asked)
            self._fit = peak.result()
            if self._fit is not None:
                yield from self._ask_who()
                return
            vain += [here, top]
        yield PointAt(self.az_deg, self.el_deg)

    def _listen(self, az_deg: float, el_deg: float) -> Listening:
        """Listen there, unless it is beyond the limits."""
        heard = yield from listen_at(self._ear, az_deg, el_deg, optional=True)
        if heard is not None:
            self._heard.append(heard)
        return heard

    def _floor(self) -> Listening:
        """Listen off the arc: the sky above it is colder than the one below."""
        away = FLOOR_AWAY * self._width
        for el_deg in (self.el_deg + away, self.el_deg - away, self.el_deg):
            if not 0.0 < el_deg < MOST_EL_DEG:
                continue
            heard = yield from listen_at(self._ear, self.az_deg, el_deg, FLOOR_READS, optional=True)
            if heard is not None:
                self._heard.append(heard)
                return heard
        return None

    def _stands_out(self, here: HeardDirection, floor: HeardDirection) -> bool:
        # Most directions are empty: their middle shows a floor that was measured over something warm.
        low = min(floor.mean, median(each.mean for each in self._heard))
        noise = max(noise_of(self._heard), LEAST_NOISE)
        sigma = noise * math.sqrt(1.0 / len(here.values) + 1.0 / len(floor.values))
        return here.mean - low > OUTSTANDING * sigma

    def _uphill(self, here: HeardDirection) -> Climb:
        """Go to the strongest of the four directions around, until there is none stronger."""
        step = STEP * self._width
        seen = [here]
        for _ in range(MOST_UPHILL):
            best = here
            for right, up in ((step, 0.0), (0.0, step), (-step, 0.0), (0.0, -step)):
                az_deg, el_deg = _beside(here, right, up)
                if any(_is_near(each, az_deg, el_deg, step / 3.0) for each in seen):
                    continue
                other = yield from self._listen(az_deg, el_deg)
                if other is not None:
                    seen.append(other)
                    best = max(best, other, key=lambda each: each.mean)
            if best is here:
                break
            here = best
        return here

    def _main_lobe(self, top: HeardDirection, floor: HeardDirection) -> Climb:
        """Look around for something much stronger, of which this may be the sidelobe, and go uphill there."""
        best = top
        for index in range(RING_POINTS):
            turn = math.radians(index * 360.0 / RING_POINTS)
            reach = RING * self._width
            other = yield from self._listen(*_beside(top, reach * math.cos(turn), reach * math.sin(turn)))
            if other is not None and self._rise(other, floor) > MAIN_LOBE * self._rise(top, floor):
                best = max(best, other, key=lambda each: each.mean)
        if best is top:
            return top
        return (yield from self._uphill(best))

    def _rise(self, here: HeardDirection, floor: HeardDirection) -> float:
        """Return how far it rises, in power where decibels are heard."""
        if self._ear.decibels:
            return math.pow(10.0, (here.mean - floor.mean) / 10.0) - 1.0
        return here.mean - floor.mean

    def _ask_who(self) -> Steps:
        """Read what the machine tells of the signal, on another transponder where it does not lock on this one."""
        able = self.identify.split()
        for transponder in (None, *TRANSPONDERS):
            if transponder is not None:
                if TRANSPONDER not in able:
                    return
                yield WriteFeature(TRANSPONDER, float(transponder))
                self._told[TRANSPONDER] = float(transponder)
            for _ in range(LOCK_TRIES):
                answer = yield ReadFeatures(tuple(name for name in TOLD_BY if name in able))
                self._told |= {each: answer.readings[each].value for each in TOLD_BY if each in answer.readings}
                if self._told.get(LOCK) is not False and self._told.get(NETWORK) != NO_NETWORK:
                    return
                yield Wait(answer.now_s + LOCK_EVERY_S)

    @property
    def progress(self) -> tuple[int, int]:
        """How many directions of the spiral were heard, and how many there are at most."""
        return self._done, self._of

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """The middle of the source as `PeakTask` tells it, and `lock`, `snr` and `network` as far as they were told."""
        return {} if self._fit is None else {**self._fit.values(), **self._told}

    @property
    def end_words(self) -> str:
        """Say where the satellite is, or that there is none."""
        if self._fit is not None:
            return self._fit.words
        if not self._heard:
            return LOST
        return (
            f"No signal stands out within {self.reach_az_deg:g}° to the sides and {self.reach_el_deg:g}° up and down. "
            "The dish is back in the predicted direction."
        )

    def result(self) -> BeamFit | None:
        """Return the fit; None where nothing was found."""
        return self._fit


def values_for(
    meant: SlotSeen, among: Sequence[SlotSeen], reach_deg: tuple[float, float], width_deg: float,
    features: Collection[str],
) -> dict[str, TaskValue]:  # fmt: skip
    """Return the values of the task for a slot; `reach_deg` to the sides, and up and down; `features` of the dish."""
    beam = width_deg or ASSUMED_WIDTH_DEG
    return {
        "az_deg": meant.az_deg, "el_deg": meant.el_deg, "width_deg": width_deg,
        "reach_az_deg": reach_deg[0], "reach_el_deg": reach_deg[1],
        "patterns": patterns_within(meant.az_deg, meant.el_deg, among, reach_deg, beam),
        "identify": " ".join(each for each in IDENTIFIED_BY if each in features),
    }  # fmt: skip


def _around(ring: int) -> Iterator[tuple[int, int]]:
    """Yield the cells of a square ring one after the other, each beside the one before."""
    for x in range(-ring, ring):
        yield x, -ring
    for y in range(-ring, ring):
        yield ring, y
    for x in range(ring, -ring, -1):
        yield x, ring
    for y in range(ring, -ring, -1):
        yield -ring, y


def _beside(here: HeardDirection, right_deg: float, up_deg: float) -> tuple[float, float]:
    el_deg = min(max(here.el_deg + up_deg, -MOST_EL_DEG), MOST_EL_DEG)
    return wrap_360(here.az_deg + right_deg / math.cos(math.radians(el_deg))), el_deg


def _is_near(heard: HeardDirection, az_deg: float, el_deg: float, within_deg: float) -> bool:
    return separation(heard.az_deg, heard.el_deg, az_deg, el_deg) < within_deg
