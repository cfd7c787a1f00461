"""A station as far as the control channel sees one."""

from __future__ import annotations

import threading
from concurrent.futures import Future

from birdcage.base.clock import VirtualClock
from birdcage.link.transcript import Transcript
from birdcage.station.events import LinkChanged, StopConfirmed
from birdcage.station.requests import Request
from birdcage.station.state import LinkPhase, LinkState, StationState, StopReport
from birdcage.station.state_store import StateStore


class OwnerStandIn:
    """A station as far as a control server sees one: it confirms each STOP at once."""

    def __init__(self, port: str, asked: str | None = None) -> None:
        self.clock = VirtualClock()
        self.board = StateStore(self.clock, StationState(port=port))
        self.asked_port = asked or port
        self.stops: list[str] = []
        self.asked: list[Request] = []
        self.answers: dict[type, object] = {}
        """What requests of these types are answered; the others get None."""
        self.transcript = Transcript(None, version="test")
        self.steering = False
        self.thawed = threading.Event()
        """While it is not set, STOP does not come back, as in a program that is frozen."""
        self.thawed.set()
        self.subscribe, self.watch, self.warn = self.board.subscribe, self.board.watch, self.board.warn

    @property
    def state(self) -> StationState:
        return self.board.state

    def is_steering(self) -> bool:
        return self.steering

    def pass_on_wire(self, direction, data: bytes) -> None:
        self.transcript.record(direction, data, self.clock.utc())

    def submit(self, request: Request) -> Future[object]:
        self.asked.append(request)
        future: Future[object] = Future()
        answer = self.answers.get(type(request))
        if isinstance(answer, Exception):
            future.set_exception(answer)
        else:
            future.set_result(answer)
        return future

    def show_network(self, network) -> None:
        self.board.change(network=network)

    def stop(self, by: str) -> None:
        self.thawed.wait(30)
        self.stops.append(by)
        report = StopReport(by, self.clock.monotonic(), "retarget", True, "Stands still.")
        self.board.change(last_stop=report)
        self.board.tell(StopConfirmed(*self.board.stamp(), report))

    def link(self, state: LinkPhase, **fields) -> None:
        self.board.change(link=LinkState(state), **fields)
        self.board.tell(LinkChanged(*self.board.stamp(), self.state.link))
