"""Keeps the dish on a satellite that wanders: a small peak now and then, and in between where it should be by those.

Step-track with memory: see `SiderealOrbit`. For satellites whose elements are not at hand; with elements, follow it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from birdcage.base.errors import StoreError
from birdcage.base.geometry import separation
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG, BeamFit, HeardDirection
from birdcage.signal.ear import Ears, fit_heard, own_tuner
from birdcage.signal.listen import check_number, check_patterns, listen_at, neighbours_in
from birdcage.signal.peak_task import NO_PEAK, SIDE, SPACING, grid_about
from birdcage.signal.sidereal_memory import FoundDirection, Prediction, SiderealMemory, SiderealOrbit
from birdcage.station.task import Task
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, Steps, Wait

SMALL_SIDE, SMALL_SPACING = 3, 0.25
"""The small peak: no direction loses more than 1.5 dB, so that what is received goes on."""
SURE = 0.1
"""A prediction that is less sure than this part of the width calls for a peak."""
MOVES = 0.02
"""The dish goes after the prediction in such parts of the width."""
LOOK_S = 20.0
MOST_SIGMAS = 4.0
"""A peak may be so many standard deviations from the prediction."""
MOST_MISSES = 3
MOST_HOURS = 240.0
GONE = "The satellite was not heard three times in a row. The dish stays where it should be."
REACHED = "The time is over. The dish stays on the satellite."


@dataclass
class StepTrackTask(Task):
    """Follows by its signal what stands about a true direction now; a peak at least every `every_s`.

    Angles in degrees. `name`: under which it is remembered; empty: this time only. `width_deg` is the width of the
    beam that is expected, 0 for an unknown one. It ends after `hours`. `patterns` and `source` as for `PeakTask`.
    """

    kind = "step-track"
    goes_on = False
    cut_words = "The satellite is not followed any more."
    holder: str
    az_deg: float
    el_deg: float
    name: str = ""
    width_deg: float = 0.0
    every_s: float = 900.0
    hours: float = 24.0
    patterns: tuple[tuple[float, ...], ...] = ((),)
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    memory: SiderealMemory = field(default_factory=lambda: SiderealMemory(None), repr=False)
    _known: list[FoundDirection] = field(default_factory=list, init=False)
    _fit: BeamFit | None = field(default=None, init=False)
    _peaks: int = field(default=0, init=False)
    _misses: int = field(default=0, init=False)
    _trouble: str = field(default="", init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no step-track."""
        check_number("az_deg", self.az_deg, -720.0, 720.0)
        check_number("el_deg", self.el_deg, -85.0, 85.0)
        check_number("width_deg", self.width_deg, 0.0, 60.0)
        check_number("every_s", self.every_s, 30.0, 86400.0)
        check_number("hours", self.hours, 0.01, MOST_HOURS)
        check_patterns(self.patterns)
        if not isinstance(self.name, str):
            raise TypeError(f"name is {self.name!r}. Give a text")
        self._ear = self.ears(self.source)

    @property
    def _width(self) -> float:
        return self.width_deg or ASSUMED_WIDTH_DEG

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - the host counts down
        """Peak, and follow what the peaks tell, until the time is over or it is lost."""
        ends_s = now_s + self.hours * 3600.0
        try:
            self._known = list(self.memory.of(self.name, now_s)) if self.name else []
        except StoreError as error:
            self._trouble = f" {error}"
        yield from self._peak(Prediction(self.az_deg, self.el_deg, 0.0))
        peaked_s = now_s
        while self._fit is not None and now_s < ends_s and self._misses < MOST_MISSES:
            now_s = (yield Wait(min(now_s + LOOK_S, ends_s))).now_s
            there = self._prediction(now_s)
            due = now_s >= peaked_s + self.every_s
            if due or self._misses or there.sigma_deg > SURE * self._width:
                yield from self._peak(there)
                peaked_s = now_s = (yield Wait(0.0)).now_s
            elif separation(there.az_deg, there.el_deg, self.az_deg, self.el_deg) > MOVES * self._width:
                yield from self._point(there)

    def _prediction(self, now_s: float) -> Prediction:
        if not self._known:
            return Prediction(self.az_deg, self.el_deg, self._width)
        return SiderealOrbit(self._known).at(now_s)

    def _point(self, there: Prediction) -> Steps:
        self.az_deg, self.el_deg = there.az_deg, there.el_deg
        yield PointAt(self.az_deg, self.el_deg)

    def _peak(self, about: Prediction) -> Steps:
        """Listen about a direction: close by, or as far as a peak does where it was missed; and go to the middle."""
        known = bool(self._peaks) and not self._misses
        side, spacing = (SMALL_SIDE, SMALL_SPACING) if known else (SIDE, SPACING)
        heard: list[HeardDirection] = []
        begun = yield Wait(0.0)
        with self._ear.open():
            for az_deg, el_deg in grid_about(about.az_deg, about.el_deg, side, spacing * self._width):
                direction = yield from listen_at(self._ear, az_deg, el_deg, optional=True)
                if direction is not None:
                    heard.append(direction)
        ended = yield Wait(0.0)
        patterns = [neighbours_in(row) for row in self.patterns]
        fit = fit_heard(heard, self._ear, self.width_deg or None, patterns)
        if fit is None or not self._may_be(fit, about):
            self._misses += 1
            yield from self._point(about)
            return
        self._fit, self._misses = fit, 0
        self._peaks += 1
        found = FoundDirection((begun.now_s + ended.now_s) / 2.0, fit.az_deg, fit.el_deg, fit.sigma_deg)
        self._known.append(found)
        if self.name:
            self._keep(found)
        yield from self._point(self._prediction(ended.now_s))

    def _may_be(self, fit: BeamFit, about: Prediction) -> bool:
        """Return whether it is this satellite: one that is found far from where it can be is a neighbour."""
        if self._fit is None:
            return True
        off_deg = separation(fit.az_deg, fit.el_deg, about.az_deg, about.el_deg)
        return off_deg <= MOST_SIGMAS * math.hypot(fit.sigma_deg, max(about.sigma_deg, SURE * self._width))

    def _keep(self, found: FoundDirection) -> None:
        try:
            self.memory.add(self.name, found)
        except StoreError as error:
            self._trouble = f" {error}"

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """`lost`: whether it was given up; the last peak, how many there were, and what could not be kept."""
        lost = self._fit is None or self._misses >= MOST_MISSES
        if self._fit is None:
            return {"lost": lost}
        told: dict[str, TaskValue] = {
            "peaks": self._peaks,
            "remembered": len(self._known),
            "trouble": self._trouble.strip(),
        }
        return {**self._fit.values(), **told, "lost": lost}

    @property
    def end_words(self) -> str:
        """Say why it is over."""
        if self._fit is None:
            return NO_PEAK
        return (GONE if self._misses >= MOST_MISSES else REACHED) + self._trouble
