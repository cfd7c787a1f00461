"""Who is attached to a station: a name of its own for each, and what becomes of control when one is gone."""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection
from concurrent.futures import Future

from birdcage.station.events import Event
from birdcage.station.plan_form import PlanLines
from birdcage.station.requests import ReleaseLease
from birdcage.station.services import Services
from birdcage.station.state import MOVING, StationState
from birdcage.station.station import Station
from birdcage.station.wire_stream import OnWire


class Attachments:
    """Of one station. Any thread.

    The motion of a program that is gone goes on to its end, and so do its tasks; then its control is given back.
    """

    def __init__(self, station: Station, program: str, on_wire: OnWire | None, services: Services) -> None:
        self._station = station
        self.services, self.plan_lines = services, PlanLines()
        """What attached programs can join, and the plans that they are told."""
        self.program, self.on_wire = program, on_wire
        """How the station's program is called by those that are attached, and how its wire is heard."""
        self._lock = threading.Lock()
        self._holders: dict[str, set[str]] = {}
        """By whom is attached: the names under which it has asked for something."""
        self._left: dict[str, list[Future[object]]] = {}
        """Names of those who are gone, and what they still wait for."""
        self._unsubscribe: Callable[[], None] | None = None
        """Ends hearing of the station, which is done while somebody has left something behind."""

    def close(self) -> None:
        """Hear no more of the station."""
        with self._lock:
            self._left.clear()
            self._hear_while_needed()

    def join(self, name: str) -> str:
        """Attach somebody; return its name here, with a number behind it where another one is called so.

        One that comes back keeps the control that it left with.
        """
        with self._lock:
            own, number = name, 1
            while own in self._holders:
                number += 1
                own = f"{name} {number}"
            self._holders[own] = {own}
            self._left.pop(own, None)
            self._hear_while_needed()
        return own

    def ask_as(self, name: str, holder: str) -> None:
        """Note that whoever is called `name` asks for something as `holder`."""
        with self._lock:
            self._holders[name].add(holder)
            self._left.pop(holder, None)

    def leave(self, name: str, waits_for: Collection[Future[object]]) -> None:
        """Somebody is gone, and did not hear what became of these requests."""
        with self._lock:
            holders = self._holders.pop(name)
            here = set[str]().union(*self._holders.values())
            self._left |= {holder: list(waits_for) for holder in holders - here}
            self._hear_while_needed()
        for future in waits_for:
            future.add_done_callback(lambda _done: self._look())
        self._look()

    def _hear_while_needed(self) -> None:
        if self._left and self._unsubscribe is None:
            self._unsubscribe = self._station.subscribe(self._look)
        elif not self._left and self._unsubscribe is not None:
            self._unsubscribe()
            self._unsubscribe = None

    def _look(self, _event: Event | None = None) -> None:
        """Give back the control of those who are gone, once nothing of theirs moves."""
        state, free = self._station.state, []
        with self._lock:
            for holder, waits_for in list(self._left.items()):
                if all(future.done() for future in waits_for) and not _is_at_work(state, holder):
                    del self._left[holder]
                    free += [holder] if state.holder == holder else []
            self._hear_while_needed()
        for holder in free:
            self._station.submit(ReleaseLease(holder))


def _is_at_work(state: StationState, holder: str) -> bool:
    """Return whether what a holder has begun goes on."""
    moves = state.holder == holder and (state.motion is not None or state.activity in MOVING)
    return moves or any(task.holder == holder for task in state.tasks)
