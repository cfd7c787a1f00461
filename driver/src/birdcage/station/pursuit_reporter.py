"""Tells of a pursuit: its phase in the state, and how well the dish points."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Unpack

from birdcage.antenna.alignment import Alignment
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.geometry import offset, separation, wrap_360
from birdcage.station.events import Followed, PursuitChanged
from birdcage.station.pursuit_state import Phase, PointingSample, Pursuit, PursuitChanges
from birdcage.station.state import Pointing, StationState
from birdcage.station.state_store import StateStore

if TYPE_CHECKING:
    from birdcage.tracking.curve import Curve
    from birdcage.tracking.plan import Plan
    from birdcage.tracking.pursuit_context import PursuitContext


ABOUT_S = 0.5
"""Which way the target goes is told by where it is so long before and after."""
EVERY_S = 0.8
"""Samples closer together than this are one; mechanical seconds."""


@dataclass(slots=True)
class _Errors:
    """What the samples come to so far."""

    count: int = 0
    squares: float = 0.0
    greatest_deg: float = 0.0

    def take(self, sample: PointingSample) -> None:
        """Count a sample in."""
        self.count += 1
        self.squares += sample.error_deg**2
        self.greatest_deg = max(self.greatest_deg, sample.error_deg)

    @property
    def rms_deg(self) -> float | None:
        """None before the first sample."""
        return math.sqrt(self.squares / self.count) if self.count else None

    @property
    def max_deg(self) -> float | None:
        """None before the first sample."""
        return self.greatest_deg if self.count else None


class PursuitReporter:
    """The pursuit in the state is its only memory of it, the errors aside."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna) -> None:
        self._store, self._antenna = store, antenna
        self._errors = _Errors()
        self._sampled_s = -math.inf

    @property
    def live(self) -> Pursuit | None:
        """The pursuit, unless it is over."""
        pursuit = self._store.state.pursuit
        return None if pursuit is None or pursuit.phase is Phase.OVER else pursuit

    def begin(self, pursuit: Pursuit) -> None:
        """A pursuit begins; its first phase is told as soon as it is known."""
        self._errors, self._sampled_s = _Errors(), -math.inf
        self._store.change(pursuit=pursuit)

    def enter(self, phase: Phase, why: str, next_what: str = "", next_at: datetime | None = None) -> None:
        """It is in another phase."""
        since = self._store.clock.monotonic()
        self.change(phase=phase, why=why, next_what=next_what, next_at=next_at, since=since)

    def change(self, **changes: Unpack[PursuitChanges]) -> None:
        """Replace fields of it, and tell everybody."""
        pursuit = self._store.state.pursuit
        assert pursuit is not None, "something is said of one"
        pursuit = replace(pursuit, **changes)
        self._store.change(pursuit=pursuit)
        self._store.tell(PursuitChanged(*self._store.stamp(), pursuit))

    def sample(self, context: PursuitContext, seen_s: float, now_s: float) -> None:
        """Tell how well the last reading points, which was made at `seen_s`; about once a second (POSIX seconds)."""
        live = self.live
        waits = context.guide is not None and seen_s < context.guide.from_s  # the target is not in reach yet
        here = self._store.state.position
        if live is None or waits or seen_s - self._sampled_s < EVERY_S or (here is not None and here.modelled):
            return
        sample = _sample_of(live.plan, self._store.state, self._antenna.alignment, seen_s)
        if sample is None:
            return
        self._sampled_s = seen_s
        self._errors.take(sample)
        what, at_s = context.upcoming(now_s)
        self._store.change(
            pursuit=replace(
                live, sample=sample, rms_error_deg=self._errors.rms_deg, max_error_deg=self._errors.max_deg,
                latency_s=None if context.guide is None else context.guide.latency_s, next_what=what,
                next_at=None if at_s is None else datetime.fromtimestamp(at_s, UTC),
            )
        )  # fmt: skip
        self._store.tell(Followed(*self._store.stamp(), live.number, sample))


def _sample_of(plan: Plan, state: StationState, alignment: Alignment, seen_s: float) -> PointingSample | None:
    """Return how well the last reading, made at `seen_s` (POSIX), points; None if there is none to judge.

    A reading counts the motor; where the play of the gear is known, the error is that of what hangs behind it.
    """
    here = state.position
    beam = None if state.beam is None else state.beam.at(plan.aim.frequency_hz)
    if here is None or plan.course is None:
        return None
    target_az, target_el = plan.sky.at(seen_s)
    planned_az, planned_el = alignment.to_true(*plan.course.at(seen_s))
    points_az, points_el = _behind_the_play(plan.course, state, alignment, here, seen_s)
    error = separation(target_az, target_el, points_az, points_el)
    expected = error if plan.pointing is None else plan.pointing.at(seen_s, error)
    lost_db = None
    if beam is not None and expected is not None:
        # The share of the elements is of unknown direction.
        added_deg = math.sqrt(max(expected**2 - error**2, 0.0))
        lost_db = beam.loss_db(*offset(target_az, target_el, points_az, points_el)) + beam.most_loss_db(added_deg)
    commanded = state.target_az_deg, state.target_el_deg
    return PointingSample(
        here.at, here.utc, wrap_360(target_az), target_el, wrap_360(planned_az), planned_el,
        commanded[0] if commanded[0] is not None else here.az_deg,
        commanded[1] if commanded[1] is not None else here.el_deg,
        here.az_deg, here.el_deg, error, lost_db, expected,
    )  # fmt: skip


def _behind_the_play(
    course: Curve, state: StationState, alignment: Alignment, here: Pointing, seen_s: float
) -> tuple[float, float]:
    """Return where the dish points, in true degrees: half the play behind its motors, as far as that is known."""
    dish = state.dish
    if dish is None or not (dish.azimuth.play_deg or dish.elevation.play_deg):
        return here.az_deg, here.el_deg
    before, after = course.at(seen_s - ABOUT_S), course.at(seen_s + ABOUT_S)
    az_deg, el_deg = (
        read_deg - math.copysign((axis.play_deg or 0.0) / 2.0, goes_deg) if goes_deg else read_deg
        for axis, read_deg, goes_deg in (
            (dish.azimuth, here.dish_az_deg, after[0] - before[0]),
            (dish.elevation, here.dish_el_deg, after[1] - before[1]),
        )
    )
    return alignment.to_true(az_deg, el_deg)
