"""Tells of a pursuit: its phase in the state, and how well the dish points."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Unpack

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.station.events import Followed, PursuitChanged
from birdcage.station.pointing_samples import EVERY_S, Errors, sample_of
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitChanges
from birdcage.station.state_store import StateStore

if TYPE_CHECKING:
    from birdcage.tracking.pursuit_context import PursuitContext


class PursuitReporter:
    """The pursuit in the state is its only memory of it, the errors aside."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna) -> None:
        self._store, self._antenna = store, antenna
        self._errors = Errors()
        self._sampled_s = -math.inf

    @property
    def live(self) -> Pursuit | None:
        """The pursuit, unless it is over."""
        pursuit = self._store.state.pursuit
        return None if pursuit is None or pursuit.phase is Phase.OVER else pursuit

    def begin(self, pursuit: Pursuit) -> None:
        """A pursuit begins; its first phase is told as soon as it is known."""
        self._errors, self._sampled_s = Errors(), -math.inf
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
        sample = sample_of(live.plan, self._store.state, self._antenna.alignment, seen_s)
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
