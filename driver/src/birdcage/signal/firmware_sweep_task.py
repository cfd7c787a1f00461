"""A cut through the sky along one axis, made by the dish's own firmware, and the beam that fits to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import median, mode

from birdcage.base.geometry import shortest_turn
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION
from birdcage.signal.beam_fit import BeamFit, HeardDirection, beam_points, fit_beam
from birdcage.signal.ear import own_tuner
from birdcage.signal.listen import check_number, neighbours_in
from birdcage.signal.sweep_task import SweepTask
from birdcage.tracking.steps import CheckSweep, PointAt, Steps, SweepAxis

MOST_TRANSPONDERS = 32
SAME = 0.3
"""Readings less than this part of a step apart were made in one direction."""
THIRD = math.sqrt(20.0)
"""The scatter of third differences, for readings with a scatter of one."""
MAD = 0.6745
"""The median of what normal noise is off its middle, for a scatter of one."""
LEAST_NOISE = 0.3
"""Whole counts scatter by so much at least."""


@dataclass
class FirmwareSweepTask(SweepTask):
    """As `SweepTask`, but the dish sweeps and listens by itself, from one end of the line on.

    `transponders`: how many it goes through in each direction; their mean counts, and only directions with as many
    readings as most have (`docs/decisions/0067-a-sweep-by-the-firmware.md`). Nothing is left out at the limits: a line
    that does not fit is refused.
    """

    kind = "firmware sweep"
    transponders: int = 1
    _at: list[tuple[float, float]] = field(default_factory=list, init=False)
    """The direction of each group of readings."""
    _values: list[list[float]] = field(default_factory=list, init=False)
    _unread: int = field(default=0, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no line."""
        super().__post_init__()
        own_tuner(self.source)
        check_number("transponders", self.transponders, 1, MOST_TRANSPONDERS)
        self.transponders = round(self.transponders)

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - cut short, it is over
        """Judge the whole line, go to its end, sweep, fit, and go to the middle."""
        line = self.items()
        az_deg, el_deg = line[0]
        motor = MOTOR_AZIMUTH if self.axis == "az" else MOTOR_ELEVATION
        sweep = SweepAxis(motor, (len(line) - 1) * self.step_deg, self.step_deg, self.transponders, self._hear)
        yield CheckSweep(az_deg, el_deg, sweep)
        yield PointAt(az_deg, el_deg)
        self._unread = (yield sweep).unread
        self._take_whole()
        yield from self.finish()

    def _hear(self, az_deg: float, el_deg: float, level: float) -> None:
        """Take one reading, and count a direction once it is whole."""
        if not self._at or self._way_deg(self._at[-1], (az_deg, el_deg)) > SAME * self.step_deg:
            self._at.append((az_deg, el_deg))
            self._values.append([])
        self._values[-1].append(level)
        self._take_whole(begun=len(self._values[-1]) < self.transponders)
        self.done = min(len(self._heard), len(self.items()))

    def _way_deg(self, one: tuple[float, float], other: tuple[float, float]) -> float:
        return abs(shortest_turn(one[0], other[0])) if self.axis == "az" else abs(other[1] - one[1])

    def _take_whole(self, *, begun: bool = False) -> None:
        """Hear the directions that have as many readings as most; `begun`: the last one may get more."""
        groups = list(zip(self._at, self._values, strict=True))
        groups = groups[:-1] if begun else groups
        if groups:
            usual = mode(len(values) for _at, values in groups)
            self._heard = [HeardDirection(*at, tuple(values)) for at, values in groups if len(values) == usual]

    def _fitted(self) -> BeamFit | None:
        """Fit to the means. Transponders differ by more than noise: that is read from how ragged the line is."""
        means = [HeardDirection(each.az_deg, each.el_deg, (each.mean,)) for each in self._heard]
        points = beam_points(means, raggedness([each.mean for each in means]))
        return fit_beam(points, self.width_deg or None, [neighbours_in(row) for row in self.patterns], self.axis)

    @property
    def end_words(self) -> str:
        """As `SweepTask`, with what else has to be known."""
        unread = f" {self._unread} lines could not be read." if self._unread > 1 else ""
        unread = " One line could not be read." if self._unread == 1 else unread
        return f"{super().end_words}{unread} The transponder may have changed."


def raggedness(levels: Sequence[float]) -> float:
    """Return the standard deviation of one level of a smooth line, by the median of its third differences."""
    thirds = [
        abs(d - 3.0 * c + 3.0 * b - a) for a, b, c, d in zip(levels, levels[1:], levels[2:], levels[3:], strict=False)
    ]  # fmt: skip
    return max(LEAST_NOISE, median(thirds) / MAD / THIRD) if thirds else 0.0
