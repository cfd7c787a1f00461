"""A station that another program has: a face keeps it as it keeps its own, over the control channel.

When that program ends, the state says so, and this attaches again as soon as one has the port.
"""

from __future__ import annotations

import itertools
import logging
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from birdcage.base.errors import BadMessage, BirdcageError, CommandRefused, LinkError, NoReply
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopMeans
from birdcage.station.attach_messages import (
    LONGEST_ASKED,
    STATE_CHANGED,
    STATE_TOLD,
    WIRE_PASSED,
    YOU,
    BesideRequest,
    HearWire,
    ShowNetwork,
    WirePiece,
    name_here,
    renamed,
    result_from_answer,
    state_from_json,
    wire_from_json,
)
from birdcage.station.control_client import NoAnswer, Owner, OwnerGone, attach_to, find_owner, owners_folder
from birdcage.station.control_messages import LONGEST_ANSWER, EndOfEvents, EventsEnded, as_line
from birdcage.station.duplex_lines import DuplexLines
from birdcage.station.events import Event, LinkChanged, PursuitChanged, StopConfirmed, StopSent
from birdcage.station.feature_report import error_of
from birdcage.station.holding import hold
from birdcage.station.json_form import VERSION, event_from_json, parse, to_json
from birdcage.station.network_state import NetworkState
from birdcage.station.pursuit_state import Phase
from birdcage.station.raw import TranscriptEntry
from birdcage.station.request_log import log_request
from birdcage.station.requests import Request, Stop, Unwatch, Watch
from birdcage.station.service_client import ServiceClient
from birdcage.station.state import Activity, LinkPhase, LinkState, StationState, StopReport
from birdcage.station.state_store import StateStore
from birdcage.station.station_clock import StationClock
from birdcage.station.task_state import TaskPhase

STOP_S = 1.0
"""A station answers a STOP at once, as it waits for no dish; after so long its program is taken for frozen."""
RETRY_S = (0.1, 0.2, 0.5, 1.0)
"""How long to wait before looking for the station again; the last one from then on."""
JOIN_S, FINISH_S = 1.0, 0.5
ENDED = "The program that drove the dish has ended, or hung up. It is unknown whether the dish moves. Attaching again."
TOO_SLOW = "This program did not keep up with the station, and was dropped."
PORT_IS_FREE = "If the dish moves, cut its power. `birdcage stop` opens the port itself."

log = logging.getLogger(__name__)


class AttachedStation:
    """Keeps `StationAccess` over the control channel. `submit`, `stop`, `state` and `subscribe` are for any thread.

    Listeners are called on a thread of its own. A face that calls itself `own` goes by a name of its own there, and
    hears `own` where that name is told; whoever is `you` in the other program goes by that one's user and terminal.
    """

    def __init__(self, paths: Paths, port: str, *, own: str = YOU, by: str = "birdcage", name: str = "") -> None:
        """Attach to whoever has `port`, now or later. `by` says in logs what this program is.

        `name` is how this face is called there; empty: by user and terminal.
        """
        self.clock = StationClock()
        self._paths, self._port, self._own, self._by = paths, port, own, by
        self._name = name or (name_here() if own == YOU else f"{own}, {name_here()}")
        opening = LinkState(LinkPhase.OPENING, self.clock.monotonic(), detail=f"Looking for who has {port}.")
        self._store = StateStore(self.clock, StationState(port=port, link=opening))
        self._told: StationState | None = None
        """As the station told it last; None while none is attached."""
        self._inward: dict[str, str] = {}
        self._outward: dict[str, str] = {}
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._lines: DuplexLines | None = None
        self._open: dict[int, tuple[Future[object], type]] = {}
        self._stops: dict[int, _OpenStop] = {}
        """STOPs that are not answered yet."""
        self._hear_wire: Callable[[WirePiece], None] | None = None
        self.services = ServiceClient(self._ask)
        self._lasting: dict[object, Request | BesideRequest] = {}
        """What lasts until it is taken back, by watcher or kind: the next program is asked for it, too."""
        self._owner: Owner | None = None
        self._program = ""
        self._met = threading.Event()
        """Set while a station is attached whose state is known."""
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="attached station", daemon=True)
        self._thread.start()

    @property
    def state(self) -> StationState:
        """What is known now: immutable. While no station is attached its link is lost."""
        return self._store.state

    @property
    def is_attached(self) -> bool:
        """Whether a station is attached, and its state is known."""
        return self._met.is_set()

    @property
    def via(self) -> str:
        """The program that drives the dish, or did last: `birdcage serve (process 4711)`; empty before one did."""
        owner = self._owner
        return "" if owner is None else f"{self._program} (process {owner.pid})"

    def wait_attached(self, within_s: float) -> bool:
        """Wait until a station is attached; False if that takes longer."""
        return self._met.wait(within_s)

    def subscribe(self, listener: Callable[[Event], None], *kinds: type[Event]) -> Callable[[], None]:
        """Hear the events of these kinds, all by default: do nothing slow there. Returns what ends it."""
        return self._store.subscribe(listener, *kinds)

    def submit(self, request: Request) -> Future[object]:
        """Ask for something. The future holds its result, or a `BirdcageError` that says why not.

        NoReply (`lost`) where the station's program ended before it answered: it is unknown whether it was done.
        LinkError (`lost`) where none is attached, and CommandRefused for what has no JSON form: nothing was sent.
        A `Watch` lasts until `Unwatch`: each program that is attached to is asked for it.
        """
        future: Future[object] = Future()
        future.set_running_or_notify_cancel()
        log_request(request, future)
        if isinstance(request, Watch):
            self._lasting[request.watcher] = request
        elif isinstance(request, Unwatch):
            self._lasting.pop(request.watcher, None)
        return self._ask(request, future)

    def hear_wire(self, listener: Callable[[WirePiece], None] | None) -> Future[object]:
        """Call `listener` with what passes on the wire, on a thread of its own; None ends that. Tells as `submit`."""
        self._hear_wire = listener
        return self._ask_lasting(HearWire(listener is not None))

    def show_network(self, network: NetworkState | None) -> None:
        """Show a server of this program, and its clients, in the station, unless another is; None ends that."""
        self._ask_lasting(ShowNetwork(network))

    def _ask_lasting(self, request: BesideRequest) -> Future[object]:
        self._lasting[type(request)] = request
        future: Future[object] = Future()
        future.set_running_or_notify_cancel()
        return self._ask(request, future)

    def own_signal(self, source: str, holder: str) -> None:
        """Do nothing: the station's program says who reads a signal."""

    def _ask(self, request: Request | BesideRequest, future: Future[object]) -> Future[object]:
        number = next(self._numbers)
        try:
            line = self._line_of(number, request)
        except BirdcageError as error:
            future.set_exception(error)
            return future
        with self._lock:
            lines = self._lines
            if lines is not None:
                self._open[number] = (future, type(request))
        if lines is None:
            future.set_exception(LinkError(f"{self._none_here} Nothing was sent.", reason=Reason.LOST))
        else:
            lines.send(line)
        return future

    def stop(self, by: str) -> None:
        """STOP: the station's program was told when this returns; where there is none, `last_stop` says so.

        Without one the dish is held all the same for the programs that come after.
        """
        number = next(self._numbers)
        line = self._line_of(number, Stop(by))
        with self._lock:
            lines = self._lines
            if lines is not None:
                self._stops[number] = _OpenStop(by, time.monotonic())
        if lines is None:
            self._not_stopped(by, self._none_here, PORT_IS_FREE)
        else:
            lines.send(line)
            lines.wake()  # its answer is waited for from now on

    def close(self) -> None:
        """Detach. What was asked for goes on: its motion to its end, then control is given back."""
        self._closing.set()
        if (lines := self._lines) is not None:
            lines.wake()
        self._thread.join(JOIN_S)

    @property
    def _none_here(self) -> str:
        return f"No birdcage program drives {self._port} now."

    def _line_of(self, number: int, request: Request | BesideRequest) -> bytes:
        """Return a request as a line. CommandRefused for one that has none."""
        try:
            told = renamed(to_json(request), self._outward)
        except BadMessage as error:
            raise CommandRefused(f"{error} Nothing was sent.", reason=Reason.UNSUPPORTED) from None
        line = as_line({"v": VERSION, "id": number, "request": told})
        if len(line) > LONGEST_ASKED:
            raise CommandRefused("That is more than another program can be asked at once. Nothing was sent.")
        return line

    def _run(self) -> None:
        waits: Iterator[float] = iter(())
        while not self._closing.is_set():
            try:
                owner = find_owner(owners_folder(self._paths), self._port)
                if owner is None:
                    raise OwnerGone(self._none_here)
                why = self._talk(owner)
            except OwnerGone:
                unknown = "It is unknown whether the dish moves. " if self._owner is not None else ""
                why = f"{self._none_here} {unknown}`birdcage station run` would drive it. Looking for it."
            except (NoAnswer, BirdcageError, OSError) as error:
                why = str(error)
            if self._told is not None:
                waits = iter(RETRY_S)
            self._detach(why)
            self._closing.wait(next(waits, RETRY_S[-1]))

    def _talk(self, owner: Owner) -> str:
        """Attach, and take in what is told to the end. Return why it ended; empty for one that goes on."""
        asked = time.monotonic()
        line, ahead, attached = attach_to(owner, self._name, self._by)
        self.clock.meet(attached.at, asked, time.monotonic())
        self._inward = {YOU: attached.host, attached.name: self._own}
        self._outward = {attached.host: YOU, self._own: attached.name}
        lines = DuplexLines(line, LONGEST_ANSWER, ahead)
        with self._lock:
            self._lines, self._owner, self._program = lines, owner, attached.program
        try:
            while not self._closing.is_set() and not lines.gone:
                lines.wait(self._tell_late_stops())
                while (told := lines.next_line()) is not None:
                    ended = self._take(told)
                    if ended is not None:
                        return "" if ended is EndOfEvents.SLOW else ENDED
            return ENDED
        except (BadMessage, ValueError) as error:
            return f"The program that has {self._port} speaks another form. Use the same birdcage in both. {error}"
        finally:
            lines.finish(FINISH_S if self._closing.is_set() else 0.0)

    def _tell_late_stops(self) -> float | None:
        """Say which STOPs have no answer in time; return when to look again, in seconds. None: nothing is open."""
        now = time.monotonic()
        with self._lock:
            waiting = [stop for stop in self._stops.values() if not stop.told]
            late = [stop for stop in waiting if now >= stop.at + STOP_S]
            for stop in late:
                stop.told = True
        for stop in late[-1:]:
            words = f"{self.via} does not answer. It is unknown whether STOP was sent."
            self._not_stopped(stop.by, words, "If the dish moves, cut its power. Then end that process.")
        return min((stop.at + STOP_S - now for stop in waiting if stop not in late), default=None)

    def _take(self, line: bytes) -> EndOfEvents | None:
        """Take in one line; return why it is the last, None if it is not."""
        told = parse(line)
        if not isinstance(told, dict):
            raise BadMessage("The line holds no object of JSON.")
        if "id" in told:
            self._answered(told)
            return None
        kind = told.get("type")
        if kind == EventsEnded.__name__:
            return next((why for why in EndOfEvents if why.value == told.get("why")), EndOfEvents.CLOSING)
        if kind == WIRE_PASSED:
            self._pass_wire(told)
            return None
        if self.services.take(told):
            return None
        told = renamed(told, self._inward)
        if kind in (STATE_TOLD, STATE_CHANGED):
            is_first = self._told is None
            self._told = self.services.with_plan(state_from_json(told, self._told or StationState()))
            self._store.put(self._told)
            if is_first:
                self._met.set()
                for request in list(self._lasting.values()):
                    self._ask(request, Future())
                self.services.join_all()
                self._tell(LinkChanged(*self._store.stamp(), self._told.link))
        else:
            event = event_from_json(told)
            if isinstance(event, PursuitChanged):
                event = replace(event, pursuit=self.services.plans.in_pursuit(event.pursuit))
            self._tell(event)
        return None

    def _pass_wire(self, told: Mapping[str, Any]) -> None:
        pieces, missed = wire_from_json(told)
        if missed and pieces:
            words = f"{missed} events are not shown here. The transcript file has them."
            pieces.insert(0, WirePiece(TranscriptEntry(pieces[0].entry.utc, "#", words.encode()), steered=False))
        for piece in pieces:
            if self._hear_wire is not None:
                self._hear_wire(piece)

    def _answered(self, told: Mapping[str, Any]) -> None:
        number = told["id"]
        with self._lock:
            self._stops.pop(number, None)
            future, request = self._open.pop(number, (None, None))
        if future is None or request is None:
            return
        if told.get("ok") is not True:
            error = told.get("error")
            future.set_exception(error_of(error if isinstance(error, dict) else {}))
            return
        try:
            future.set_result(result_from_answer(request, told.get("result")))
        except BadMessage as error:
            future.set_exception(error)
            raise

    def _detach(self, why: str) -> None:
        """Say what is so without a station: nothing is known any more, and what was asked for may be done or not."""
        self._met.clear()
        self.services.lose()
        with self._lock:
            self._lines, self._told = None, None
            unanswered, self._open = self._open, {}
            stops, self._stops = self._stops, {}
        for future, _ in unanswered.values():
            words = f"{why or TOO_SLOW} It is unknown whether this was done."
            future.set_exception(NoReply(words, reason=Reason.LOST))
        if why and not self._closing.is_set():
            self._show_lost(why)
        for stop in stops.values():
            self._not_stopped(stop.by, f"{why or TOO_SLOW} It is unknown whether STOP was sent.", PORT_IS_FREE)

    def _show_lost(self, why: str) -> None:
        at, utc = self._store.stamp()
        state = self._store.state
        if state.link.state is LinkPhase.LOST and state.link.detail == why:
            return
        link = LinkState(LinkPhase.LOST, at, state.link.last_reply, detail=why, reason=Reason.LOST)
        pursuit = state.pursuit
        if pursuit is not None and pursuit.phase is not Phase.OVER:
            pursuit = replace(pursuit, phase=Phase.INTERRUPTED, since=at, why=why, next_what="", next_at=None)
        self._store.change(
            link=link, position_lost=state.position_lost or Reason.LINK, motion=None, holder=None, pursuit=pursuit,
            activity=Activity.UNKNOWN, activity_since=at, activity_text="", raw_activity=False, signal_owners={},
            tasks=tuple(replace(task, phase=TaskPhase.INTERRUPTED, since=at, why=why) for task in state.tasks),
        )  # fmt: skip
        self._tell(LinkChanged(at, utc, link))

    def _not_stopped(self, by: str, why: str, remedy: str) -> None:
        """Say that STOP did not reach the dish, and hold it for the programs that come after."""
        at, utc = self._store.stamp()
        report = StopReport(by, at, StopMeans.NO_LINK, confirmed=False, sentence=f"{why} {remedy}")
        self._store.change(last_stop=report)
        self._tell(StopSent(at, utc, replace(report, confirmed=None)))
        self._tell(StopConfirmed(at, utc, report))
        threading.Thread(target=self._hold, args=(by, utc), name="hold the dish", daemon=True).start()

    def _hold(self, by: str, utc: datetime) -> None:
        try:
            hold(self._paths, self._port, by, utc)
        except (BirdcageError, OSError) as error:  # a port may go while it is looked at
            log.warning("the dish is not held for other programs: %s", error)

    def _tell(self, event: Event) -> None:
        try:
            self._store.tell(event)
        except Exception:  # a listener is anybody's code: STOP and answers of the station come on this thread, too
            log.exception("a listener to events has failed, and hears no more")


@dataclass(slots=True, eq=False)
class _OpenStop:
    """A STOP that is not answered yet."""

    by: str
    at: float
    """When it was called, in monotonic seconds of this program."""
    told: bool = False
    """Whether it was said that no answer came."""
