"""A sweep that the machine makes by itself, as one exchange: what it tells meanwhile, STOP in the middle, its end."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future

from birdcage.antenna.axis_sweep import AxisSweep
from birdcage.base.errors import Stopped
from birdcage.base.held import HeldReason
from birdcage.rotator.ladder import MoveKind
from birdcage.rotator.values import Position
from birdcage.station.mover import Job
from birdcage.station.parts import Parts
from birdcage.station.state import Activity
from birdcage.tracking.steps import CheckSweep, SweepAxis

ASTRAY = "the sweep left the range that was asked for"


class SweepExchange:
    """On the station's thread, which it keeps until the dish shows its prompt again: nothing else may be sent."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._antenna = parts, parts.antenna
        self._sweep = AxisSweep(parts.antenna)
        self.on_part: Callable[[], None] = lambda: None
        """Told after each reading that whoever asked for the sweep has heard."""
        self.unread = 0
        """How many lines of the last one could not be read."""

    def check(self, step: CheckSweep) -> None:
        """Raise MotionRefused unless the dish may sweep from there. Sends nothing."""
        start = Position(*self._antenna.alignment.to_dish(step.az_deg, step.el_deg))
        sweep = step.sweep
        self._sweep.check(sweep.axis, start, sweep.span_deg, sweep.step_deg, sweep.transponders)

    def run(self, step: SweepAxis, holder: str) -> Future[object]:
        """Sweep; the future is done when the dish was seen at rest after it. Raises what the dish raises.

        Stopped where STOP was called meanwhile: its follow-up then looks whether the dish rests.
        """
        parts, moving, mover = self._parts, self._antenna.moving, self._parts.mover
        parts.free_wire()
        moving.keep_busy(MoveKind.SWEEP)  # first: a STOP that comes with the event must not promise anything
        mover.forget_target()
        mover.activity(Activity.SWEEPING, self._antenna.rotator.facts.numbered[step.axis].name)
        try:
            self.unread = self._sweep.run(
                step.axis, step.span_deg, step.step_deg, step.transponders,
                lambda dish, level: self._hear(step, dish, level), self._astray,
            )  # fmt: skip
        except BaseException:
            if parts.store.state.activity is Activity.SWEEPING:
                mover.activity(Activity.UNKNOWN, "")
            raise
        finally:
            moving.keep_busy(None)
            moving.forget()
            parts.stopper.resume()
        if parts.control.latched:
            raise Stopped("STOP came while the dish swept.")
        # No source says whether it stays where the sweep ends.
        future: Future[object] = Future()
        mover.await_rest(Job(0.0, 0.0, holder, future))
        return future

    def _hear(self, step: SweepAxis, dish: Position, level: float) -> None:
        here = self._parts.reader.swept(dish)
        if self._parts.control.latched:
            self._parts.stopper.sweep_goes_on()
        else:
            step.hear(here.az_deg, here.el_deg, level)
            self.on_part()

    def _astray(self) -> None:
        """It goes where nothing was judged: stop it, as far as it can be."""
        self._parts.stopper.call("birdcage", HeldReason.OTHER, detail=ASTRAY)
        self._parts.stopper.take_calls()
