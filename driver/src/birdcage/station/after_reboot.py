"""Takes an unattended dish up again after its power has failed: `station.after_reboot = home`."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass

from birdcage.base.errors import BirdcageError
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.events import FaultAcknowledged, Recovered
from birdcage.station.parts import Parts
from birdcage.station.search_control import SearchControl
from birdcage.station.state import Activity, Fault, LinkPhase, TvSearch
from birdcage.station.tasks.homing import HomingTask
from birdcage.station.tasks.host import TaskHost

QUIET_S = 5.0
"""How long the dish has to be quiet and at rest first: it may be starting still."""
BY = "station.after_reboot"
"""Who homes the dish, and acknowledges the fault."""


@dataclass
class RecoveryTask(HomingTask):
    """Homes a dish that has restarted, once the countdown is over."""

    kind = "recovery"
    gives_back = True
    is_unattended = True


class AfterReboot:
    """Once for each restart: ends the TV search, homes, and lets what was interrupted go on.

    What a person has stopped stays stopped, and where homing fails the fault stays. The station's thread.
    """

    def __init__(self, parts: Parts, host: TaskHost) -> None:
        self._parts, self._store, self._control, self._host = parts, parts.store, parts.control, host
        self._homes = parts.settings.home_after_reboot
        self._search = SearchControl(parts)
        self._tried: Fault | None = None
        self._homing: Future[object] | None = None

    def due(self, now: float) -> float | None:
        """Return when there is something to do, in monotonic seconds; None if there is nothing."""
        if self._homing is not None:
            return now if self._homing.done() else None
        state = self._store.state
        fault, held = state.fault, state.held
        if not self._homes or fault is None or fault is self._tried or not fault.is_of_power:
            return None
        if held is not None and held.reason is not HeldReason.FAULT:
            return None
        if state.link.state is not LinkPhase.UP or state.activity is not Activity.IDLE:
            return None
        return max(state.link.since, state.activity_since) + QUIET_S

    def tick(self) -> None:
        """Begin, or take in how it ended."""
        if self._homing is not None:
            homing, self._homing = self._homing, None
            self._ended(homing.exception())
            return
        self._tried = self._store.state.fault
        try:
            self._begin()
        except BirdcageError as error:
            self._ended(error)

    def _begin(self) -> None:
        rotator = self._parts.antenna.rotator
        if rotator.facts.no_homing:
            return
        self._parts.free_wire()
        ends_search = rotator.facts.search_switch is SearchSwitch.UNTIL_POWER_UP
        if ends_search and self._store.state.search is TvSearch.RUNNING:
            self._search.refuse(disabled=True)
            self._search.set(disabled=True)
        axes = (rotator.facts.azimuth.index, rotator.facts.elevation.index)
        self._control.despite_fault = BY
        self._parts.stopper.release(self._parts.stopper.count)
        self._parts.antenna.moving.forget()
        self._store.change(homed=None, position=None, position_lost=Reason.HOMING)
        self._homing = Future()
        self._host.begin(RecoveryTask(BY, axes, whole=True), asked=False, future=self._homing)

    def _ended(self, error: BaseException | None) -> None:
        self._control.despite_fault = ""
        fault = self._store.state.fault
        if error is None and fault is self._tried and fault is not None:
            self._store.change(fault=None)
            self._store.tell(FaultAcknowledged(*self._store.stamp(), fault, BY))
            sentence = "The dish has restarted and was homed again. What was interrupted goes on."
            self._store.tell(Recovered(*self._store.stamp(), sentence))
        elif not self._control.latched:
            self._control.hold("birdcage", HeldReason.FAULT)
