"""Serves `Run`: judges a motor that is to run while it is held as any motion is, and begins or renews it."""

from __future__ import annotations

from birdcage.base.errors import CommandRefused, ConfirmationNeeded, MotionRefused
from birdcage.base.reason import Reason
from birdcage.rotator.feature import Feature, FeatureKind
from birdcage.station.applying import refuse_while_moving
from birdcage.station.parts import Parts
from birdcage.station.run_request import Run
from birdcage.station.tasks.host import TaskHost
from birdcage.station.tasks.motor_run import MotorRunTask


class MotorRuns:
    """Errors are raised, and become the future's. What is refused sends nothing."""

    def __init__(self, parts: Parts, host: TaskHost) -> None:
        self._parts, self._host = parts, host

    def run(self, request: Run) -> None:
        """See `Run`."""
        feature = self._feature(request.feature)
        feature.check(request.value)
        run = self._host.find(MotorRunTask.kind)
        task = None if run is None else run.task
        if isinstance(task, MotorRunTask) and (task.holder, task.feature.id) == (request.holder, feature.id):
            task.hold(request.value)
            return
        if request.renews:
            return
        if feature.hazard and not request.agreed:
            raise ConfirmationNeeded(f"{feature.hazard} Nothing was sent.")
        parts, control, antenna = self._parts, self._parts.control, self._parts.antenna
        antenna.gate.require_direction()
        control.refuse(request.holder)
        control.may_take(request.holder)
        parts.free_wire()
        refuse_while_moving(parts.store, antenna, "No motor is run")
        task = MotorRunTask(antenna, parts.store.clock, request.holder, feature, request.value)
        task.refuse()
        control.take(request.holder)
        self._host.by_hand(request.holder)
        self._host.begin(task)

    def _feature(self, name: str) -> Feature:
        antenna = self._parts.antenna
        dish, feature = antenna.rotator.facts.name, antenna.rotator.features.get(name)
        if feature is None or feature.kind is not FeatureKind.HELD or feature.held is None:
            raise CommandRefused(
                f"The {dish} has no motor {name} that can be run. Nothing was sent.", reason=Reason.UNSUPPORTED
            )
        if feature.held.axis not in (antenna.model.azimuth.name, antenna.model.elevation.name):
            raise MotionRefused(
                f"Nothing here watches the {feature.held.axis}, so its motor is not run. Nothing was sent.",
                reason=Reason.UNSUPPORTED,
            )
        if not antenna.strategy.commands:
            raise MotionRefused(
                f"The {dish} has no STOP that is known to work, so no motor is run. Nothing was sent.",
                reason=Reason.UNSUPPORTED,
            )
        return feature
