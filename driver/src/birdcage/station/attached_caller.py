"""One attached program, as the station's program serves it: requests in; state, events and answers out, in order."""

from __future__ import annotations

import logging
import socket
import threading
import time
from collections import deque
from concurrent.futures import CancelledError, Future
from dataclasses import dataclass, replace

from birdcage.base.errors import BadMessage, BirdcageError
from birdcage.base.reason import Reason
from birdcage.station.attach_messages import (
    LONGEST_ASKED,
    AskService,
    Attach,
    Attached,
    BesideRequest,
    HearWire,
    JoinService,
    ShowNetwork,
    answer_to_json,
    asked_from_json,
    name_here,
    state_to_json,
)
from birdcage.station.attachments import Attachments
from birdcage.station.control_messages import ENDS, EndOfEvents, as_line, done
from birdcage.station.duplex_lines import DuplexLines
from birdcage.station.event_stream import KERNEL_BYTES, LAST_LINE_S, LONGEST_QUEUE
from birdcage.station.events import Event, PursuitChanged
from birdcage.station.json_form import parse, to_json
from birdcage.station.network_state import NetworkState
from birdcage.station.requests import Request, Stop, Unwatch, Watch
from birdcage.station.service_visits import ServiceVisits
from birdcage.station.state import StationState
from birdcage.station.station import Station
from birdcage.station.wire_stream import WireStream

MOST_OPEN = 100
"""Requests of one caller that are not answered yet."""
STATE_S = 0.02
"""How long changes of the state without an event gather before they are told."""
LINES_AT_ONCE = 50
"""Lines of one caller that are served before it is sent something."""

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Answer:
    number: int | None
    request: type
    result: object


class AttachedCaller:
    """Runs on the thread of its caller, and waits for nothing but that one's socket."""

    def __init__(self, station: Station, attach: Attach, attachments: Attachments) -> None:
        self._station, self._attach, self._attachments = station, attach, attachments
        self._lock = threading.Lock()
        self._queue: deque[tuple[StationState, Event | _Answer]] = deque()
        self._ended: EndOfEvents | None = None
        self._latest = station.state
        self._told: StationState | None = None
        self._told_at = 0.0
        self._told_last = False
        """Whether the last line is on its way."""
        self._name = ""
        self._watchers: set[str] = set()
        self._network: NetworkState | None = None
        """The server of the caller that is shown."""
        self._open: set[Future[object]] = set()
        self._lines: DuplexLines | None = None
        self._wire = WireStream(station, attachments.on_wire, self._wake)
        self._visits = ServiceVisits(attachments.services, attachments.plan_lines, self._wake)

    def end(self, why: EndOfEvents) -> None:
        """Send what waits, then a last line. Any thread."""
        with self._lock:
            self._ended = self._ended or why
        self._wake()

    def serve(self, line: socket.socket, ahead: bytes) -> None:
        """Talk until either side ends it; `ahead` is what the caller has said already. OSError when it is gone."""
        self._name = self._attachments.join(self._attach.name)
        line.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, KERNEL_BYTES)
        self._lines = lines = DuplexLines(line, LONGEST_ASKED, ahead)
        # In this order: each event has the state that it came with.
        unwatch, unsubscribe = self._station.watch(self._note), self._station.subscribe(self._put)
        try:
            lines.send(as_line(done(self._attach, self._welcome())))
            self._talk(lines)
        finally:
            self._wire.close()
            self._visits.close()
            unsubscribe()
            unwatch()
            for watcher in self._watchers:
                self._station.submit(Unwatch(watcher))
            if self._network is not None and self._station.state.network == self._network:
                self._station.show_network(None)
            self._attachments.leave(self._name, set(self._open))
            lines.close()

    def _welcome(self) -> Attached:
        clock = self._station.clock
        asked, program = self._station.asked_port, self._attachments.program
        return Attached(self._name, name_here(), clock.monotonic(), clock.utc(), asked, program)

    def _talk(self, lines: DuplexLines) -> None:
        until: float | None = None
        while not lines.gone:
            lines.wait(self._pause_s(until, idle=not lines.unsent))
            if self._ended is None:
                self._read(lines)
            while not lines.unsent and (told := self._next()):
                lines.send(told)
            if self._ended is not None:
                until = until or time.monotonic() + LAST_LINE_S
                if (self._told_last and not lines.unsent) or time.monotonic() > until:
                    return

    def _pause_s(self, until: float | None, *, idle: bool) -> float | None:
        """Return how long to wait at most: until the last line counts as unread, or a new state is due."""
        now = time.monotonic()
        if until is not None:
            return max(until - now, 0.0)
        return max(self._told_at + STATE_S - now, 0.0) if idle and self._latest is not self._told else None

    def _read(self, lines: DuplexLines) -> None:
        for _ in range(LINES_AT_ONCE):
            try:
                line = lines.next_line()
            except ValueError:
                self._confused(BadMessage(f"The line is longer than {LONGEST_ASKED} bytes. Ask for less."))
                return
            if line is None:
                return
            try:
                number, request = asked_from_json(parse(line))
            except BadMessage as error:
                self._confused(error)
                return
            self._take(number, request)

    def _confused(self, error: BadMessage) -> None:
        """Say what was wrong, and end: what follows such a line can't be told from its rest."""
        self._put(_Answer(None, type(None), error))
        self.end(EndOfEvents.BAD_LINE)

    def _take(self, number: int, request: Request | BesideRequest | BadMessage) -> None:
        kind: type = type(request)
        if isinstance(request, BadMessage):
            self._put(_Answer(number, kind, request))
        elif isinstance(request, Stop):
            log.debug("%s: STOP", request.by)
            self._station.stop(request.by)
            self._put(_Answer(number, kind, None))
        elif isinstance(request, BesideRequest):
            self._put(_Answer(number, kind, self._beside(request)))
        elif len(self._open) >= MOST_OPEN:
            words = f"{MOST_OPEN} requests wait for their answers already. Nothing was sent: wait for one of them."
            self._put(_Answer(number, kind, BirdcageError(words, reason=Reason.BUSY)))
        else:
            future = self._station.submit(self._as_own(request))
            self._open.add(future)
            future.add_done_callback(lambda future: self._answer(number, kind, future))

    def _beside(self, request: BesideRequest) -> BirdcageError | None:
        try:
            match request:
                case HearWire(on):
                    self._wire.hear(on=on)
                case JoinService():
                    self._visits.join(request)
                case AskService(name, order):
                    self._visits.take(name, order)
                case ShowNetwork(network):
                    self._show_network(network)
        except BirdcageError as error:
            return error
        return None

    def _show_network(self, network: NetworkState | None) -> None:
        """Show the caller's server, or none any more. One of another program's that is shown stays."""
        if self._station.state.network not in (None, self._network):
            raise BirdcageError("Another server is shown there.", reason=Reason.BUSY)
        self._network = None if network is None else replace(network, by=self._name)
        self._station.show_network(self._network)

    def _as_own(self, request: Request) -> Request:
        """Return a request as the station gets it: a watch goes by a name of its own and ends with its caller."""
        if isinstance(request, Watch | Unwatch):
            request = replace(request, watcher=f"{request.watcher} ({self._name})")
            if isinstance(request, Watch):
                self._watchers.add(request.watcher)
            else:
                self._watchers.discard(request.watcher)
        holder = getattr(request, "holder", None)
        if holder is not None:
            self._attachments.ask_as(self._name, holder)
        return request

    def _answer(self, number: int, kind: type, future: Future[object]) -> None:
        """Queue the answer. On the station's thread, as a rule."""
        self._open.discard(future)
        try:
            result = future.result()
        except BirdcageError as error:
            result = error
        except (CancelledError, Exception) as error:  # noqa: BLE001 - whatever the station has failed with
            result = BirdcageError(f"The station has failed: {error}")
        self._put(_Answer(number, kind, result))

    def _note(self, state: StationState) -> None:
        """Note a new state. Under the lock of its store: nothing here waits."""
        self._latest = state
        self._wake()

    def _put(self, what: Event | _Answer) -> None:
        """Queue an event or an answer, with the state that goes before it. Nothing here waits for the caller."""
        with self._lock:
            if self._ended is None:
                self._queue.append((self._latest, what))
                if len(self._queue) > LONGEST_QUEUE:
                    self._queue.clear()
                    self._ended = EndOfEvents.SLOW
        self._wake()

    def _wake(self) -> None:
        if self._lines is not None:
            self._lines.wake()

    def _next(self) -> bytes:
        """Return what is to be sent next; empty if nothing is."""
        with self._lock:
            # With the lock: what is queued from now on has a state that is no older than this one.
            state, what = self._queue.popleft() if self._queue else (self._latest, None)
            ended = self._ended
        if what is not None:
            return self._tell(state) + self._line_of(what)
        if ended is not None:
            first, self._told_last = not self._told_last, True
            return as_line(to_json(ENDS[ended])) if first else b""
        is_due = self._told is None or time.monotonic() >= self._told_at + STATE_S
        return (self._tell(state) if is_due else b"") or self._visits.next_lines() or self._wire.next_line()

    def _tell(self, state: StationState) -> bytes:
        told = None if state is self._told else state_to_json(state, self._told)
        self._told, self._told_at = state, time.monotonic()
        return b"" if told is None else self._visits.plans.line_of_pursuit(state.pursuit) + as_line(told)

    def _line_of(self, what: Event | _Answer) -> bytes:
        if isinstance(what, _Answer):
            return as_line(answer_to_json(what.number, what.request, what.result))
        try:
            plan = self._visits.plans.line_of_pursuit(what.pursuit) if isinstance(what, PursuitChanged) else b""
            return plan + as_line(to_json(what))
        except BadMessage as error:
            log.warning("an event is not told to other programs: %s", error)
            return b""
