"""The exchanges of tasks that are more than a move: homing an axis, taking its reference, reading features."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator.feature import Reading
from birdcage.rotator.feature_table import ends_reading
from birdcage.rotator.ladder import MoveKind
from birdcage.station.motor_run_exchange import MotorRunExchange
from birdcage.station.parts import Parts
from birdcage.station.state import Activity
from birdcage.tracking.steps import HomeAxis, ReadFeatures, RunMotor, TakeReferences, WriteFeature


class DishExchanges:
    """One at a time, on the station's thread. Raise what the dish raises."""

    def __init__(self, parts: Parts) -> None:
        self._parts, self._antenna, self._mover = parts, parts.antenna, parts.mover
        self._run = MotorRunExchange(parts)
        self._homes = False
        """Whether the dish is shown as homing because of this."""

    def carry_out(self, step: HomeAxis | RunMotor | TakeReferences) -> None:
        """Do one that has no answer but that it was done."""
        if isinstance(step, HomeAxis):
            self.home(step.axis)
        elif isinstance(step, RunMotor):
            self._run.go(step)
        else:
            self.take_references(whole=step.whole)

    def home(self, axis: int) -> None:
        """Find the reference of an axis, a motor number. Nothing gets through to the dish meanwhile."""
        moving = self._antenna.moving
        self._homes = True
        moving.keep_busy(MoveKind.HOME)  # first: a STOP that comes with the event must not promise anything
        try:
            self._mover.activity(Activity.HOMING, self._antenna.rotator.facts.numbered[axis].name)
            self._antenna.maintenance.home(axis)
        finally:
            moving.keep_busy(None)
            self._parts.stopper.resume()

    def take_references(self, *, whole: bool) -> None:
        """Read where the dish is after homing; `whole`: count the turn of the cable from there."""
        self.drop()
        if self._parts.reader.position() is not None and whole:
            self._antenna.gate.count_cable()
            self._parts.reader.position()
        self._mover.activity(Activity.IDLE, "")

    def features(self, step: ReadFeatures | WriteFeature) -> Mapping[str, Reading]:
        """Read features, or set one, and come back to the motor menu."""
        reader, rotator = self._parts.reader, self._antenna.rotator
        reader.elsewhere = True  # STOP has to come back to the motor menu first, and look
        try:
            if isinstance(step, WriteFeature):
                return {step.id: rotator.write(step.id, step.value)}
            readings = rotator.read(step.ids)
        except (CommandRefused, NoReply) as error:
            if not (isinstance(step, ReadFeatures) and step.optional) or ends_reading(error):
                raise
            readings = {}
        finally:
            if rotator.is_open:
                rotator.make_ready()
                reader.elsewhere = False
        reader.note(readings)
        return readings

    def drop(self) -> None:
        """What was under way is over, or cut short."""
        self._run.end()
        if self._homes:
            self._homes = False
            self._mover.activity(Activity.UNKNOWN, "")
