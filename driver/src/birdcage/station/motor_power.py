"""Serves what a person does to the motors by hand: their current, and the firmware's own stow."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.base.errors import MotionRefused, PositionUnknown, Stopped
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import MoveKind
from birdcage.station.applying import refuse_while_moving
from birdcage.station.events import End
from birdcage.station.mover import Job
from birdcage.station.parts import Parts
from birdcage.station.state import Activity


class MotorPower:
    """Errors are raised, and become the future's."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._mover, self._stopper, self._reader = parts.mover, parts.stopper, parts.reader

    def release(self, holder: str, stops_seen: int) -> None:
        """Take the current off.

        It drives nothing, and is what one does when the dish hangs on its tripod and its motors push: so neither HELD
        (which STOP has just latched) nor a fault nor unreadable settings keep it back, and while HELD it takes no
        lease. Only a release that was asked for *before* STOP is dropped (Stopped): a dish that has just been stopped
        must not fall because of it. LeaseDenied while somebody else has control.
        """
        held = self._control.latched
        if not held:
            self._control.take(holder)
        self._parts.free_wire()

        def permit() -> None:
            if self._stopper.count != stops_seen:
                raise Stopped("STOP came after this request: the motors keep their current. Ask again.")

        self._antenna.maintenance.release_motors(permit=permit)
        self._mover.fail(End.STOPPED, "motors released", Stopped("The motors were released."))
        self._antenna.moving.end()
        self._reader.unknown(PositionUnknown("The motors were released.", reason=Reason.RELEASED))
        self._mover.activity(Activity.IDLE, "")
        self._stopper.motors_were_released()

    def engage(self, holder: str) -> None:
        """Put the current back on: a motion, for the dish may jerk to the next step. Its position stays unknown."""
        self._control.admit(holder)
        self._parts.free_wire()
        refuse_while_moving(self._store, self._antenna, "The motors are not engaged")
        self._antenna.rotator.engage_motors()
        self._reader.position()

    def stow(self, holder: str, future: Future[object]) -> None:
        """Fold the dish flat. The future resolves with where it came to rest; nothing is known to stop it."""
        model, state = self._antenna.rotator.facts, self._store.state
        if not model.has_stow:
            raise MotionRefused(
                f"The {model.name} has no command to stow. Nothing was sent.", reason=Reason.UNSUPPORTED
            )
        if not state.stow_allowed:
            feed = f"the feed {state.feed_name!r}" if state.feed_name else "this feed"
            raise MotionRefused(
                f"With {feed} the dish must not fold flat: it could be crushed. Nothing was sent. If the feed fits, "
                "set stow_allowed in its section of birdcage.toml.",
                reason=Reason.FEED,
            )
        self._control.admit(holder)
        self._parts.free_wire()
        refuse_while_moving(self._store, self._antenna, "The dish is not stowed")
        if self._reader.position() is None:
            raise PositionUnknown(
                "The dish does not know where it points, so it can't stow. Home it first.",
                reason=self._antenna.gate.unknown_reason,
            )
        self._mover.activity(Activity.STOWING, "")
        self._store.change(position_lost=Reason.STOWING)
        self._antenna.moving.keep_busy(MoveKind.STOW)
        try:
            self._antenna.maintenance.stow()
        except BaseException:
            if self._store.state.activity is Activity.STOWING:
                self._mover.activity(Activity.UNKNOWN, "")
            raise
        finally:
            self._antenna.moving.keep_busy(None)
            self._stopper.resume()
        if self._control.latched:
            raise Stopped("STOP came while the dish stowed.")
        self._mover.await_rest(Job(0.0, 0.0, holder, future))
