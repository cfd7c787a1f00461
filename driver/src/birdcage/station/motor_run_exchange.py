"""The exchanges of a motor that runs without a target: what sets it running, and STOP, on every way out."""

from __future__ import annotations

from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.base.held import HeldReason
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.station.parts import Parts
from birdcage.station.state import Activity
from birdcage.tracking.steps import RunMotor

TRIES, ANSWER_S = 2, 1.0
"""How often STOP is sent at the end of a run, and how long each is waited for, before the dish is HELD."""


class MotorRunExchange:
    """Of one task. The machine would go on for ever: only STOP ends what `go` begins."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._antenna = parts, parts.antenna
        self._runs = False
        self._stops = 0
        """How often STOP had been called when it began."""

    def go(self, step: RunMotor) -> None:
        """Have a motor run, from now on at this value. Raises what the machine raises: it may run all the same."""
        held = self._antenna.rotator.features[step.id].held
        assert held is not None, "whoever asked has looked"
        if not self._runs:
            self._stops = self._parts.stopper.count
        # Before the first byte: a STOP that comes after it must know that something runs.
        self._runs = self._antenna.moving.motor_runs = True
        self._parts.mover.activity(Activity.MOTOR_RUN, held.axis)
        self._antenna.rotator.write(step.id, step.value)

    def end(self) -> None:
        """Send STOP, and watch the dish come to rest. What does not answer it is HELD, and STOP is repeated there."""
        if not self._runs:
            return
        self._runs, stopper = False, self._parts.stopper
        if stopper.count != self._stops:
            return  # a person's STOP was sent, and is followed until the dish rests
        if not self._is_stopped():
            stopper.call("birdcage", HeldReason.LINK)
            stopper.take_calls()
        elif not self._parts.control.latched:
            self._parts.mover.await_stream_end()

    def _is_stopped(self) -> bool:
        """Return whether the machine has answered a STOP."""
        for _ in range(TRIES):
            try:
                self._antenna.rotator.stop_now(StopOrder(StopBy.COMMAND))
                if self._antenna.rotator.settle(ANSWER_S):
                    return True
            except NoReply:
                continue
            except (LinkError, CommandRefused):
                break
        return False
