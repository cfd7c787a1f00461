"""Serves all clients on one thread: one `select`, sockets that never block, and a wake for answers of the dish."""

from __future__ import annotations

import contextlib
import logging
import selectors
import socket
import sys
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from selectors import EVENT_READ

from birdcage.base.config import RotctldSettings
from birdcage.base.wake import Wake
from birdcage.rotctld.client_record import ClientRecord
from birdcage.rotctld.client_rotor import ClientRotor
from birdcage.rotctld.client_view import ClientRole
from birdcage.rotctld.listening import is_allowed
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.recogniser import Recogniser
from birdcage.rotctld.rprt import RotctldError
from birdcage.rotctld.served_client import ClientLimits, HangUp, ServedClient
from birdcage.rotctld.session_recorder import SessionRecorder
from birdcage.rotctld.shared_dish import SharedDish
from birdcage.station.access import StationAccess
from birdcage.station.network_state import NetworkClient, NetworkState

PUBLISH_S = 0.2
"""How often what clients do is shown."""
PUBLISH_EACH_S = 0.005
"""The same for each of many clients: making them into values takes time that their answers wait."""
LOOK_S = 1.0
"""How often it is looked for silent clients, and for what the dish has made of wishes."""
DISH_S = 0.05
"""How soon after a client has said something the dish's side looks what is due."""
MOST_LINES, FEWEST_LINES = 1000, 2
"""How many lines of what was said are shown, of all clients together; and of one where there are many."""
RESERVED = 256
"""Descriptors that clients leave to the rest of the program: the dish's port, files, other programs that call."""
FULL_S = 0.5
"""How long no client is let in after the system had no descriptor left for one."""
SILENT_S = 10.0
"""A client that was silent for so long may lose its place to a new one, if all are taken."""
LONGEST_WAIT_S = 60.0
ACCEPTED_AT_ONCE = 16
END_S = 2.0
"""How long `shutdown` waits for the serving thread."""
SWITCH_S = 0.001
"""How long another thread of this program may keep the interpreter while a client waits."""

THROUGH = "another program has the dish"
"""What a server lacks that has no recogniser: it would have to follow by a plan of its own."""

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class ClientNews:
    """A client came, or is gone."""

    client: NetworkClient
    why: HangUp | None = None
    """Why it is gone, or was not let in; None: it came."""


@dataclass(slots=True)
class _Served:
    client: ServedClient
    rotor: ClientRotor
    events: int = 0


class RotctldService:
    """The clients of one station. `serve_forever` belongs to one thread; `shutdown` is for any other.

    `show` gets who is there, for the state of the station; `tell` each client that comes and goes.
    """

    def __init__(
        self,
        station: StationAccess,
        listener: socket.socket,
        settings: RotctldSettings,
        options: RotctldOptions,
        *,
        show: Callable[[NetworkState | None], object] = lambda _state: None,
        tell: Callable[[ClientNews], object] = lambda _news: None,
        recorder: SessionRecorder | None = None,
        recogniser: Recogniser | None = None,
    ) -> None:
        """Serve those who connect to `listener` (`listening.listen`), which is closed in the end.

        `recorder` keeps what is said; who made it closes it. `recogniser` is closed in the end.
        """
        self._recorder = recorder
        self._listener, self._settings = listener, settings
        self._host, self._port = listener.getsockname()[:2]
        self._show, self._tell = show, tell
        self._clock = station.clock
        self._recogniser = recogniser
        self._dish = SharedDish(station, options, recogniser)
        self._networks = settings.networks
        self._limits = ClientLimits(settings.commands_per_s, settings.unread_s)
        self._served: dict[int, _Served] = {}
        self._due: dict[int, float] = {}
        """When something is due for a client, of those for which anything is."""
        self._dish_due: float | None = None
        self._came = self._turned_away = 0
        self._selector = selectors.DefaultSelector()
        self._wake = Wake()
        self._done: deque[int] = deque()
        """Numbers of the clients whose answer has come, from any thread."""
        self._wanted: deque[Callable[[], object]] = deque()
        """What a person wants done, from any thread."""
        self._accepts_at: float | None = None
        self._publish_at = self._look_at = self._clock.monotonic()
        self._stirred = True
        """Whether a client has come, gone or said something since they were shown."""
        self._shown: NetworkState | None = None
        self._ending = threading.Event()
        self._ended = threading.Event()
        self._thread: threading.Thread | None = None
        self.crash: BaseException | None = None
        """What ended the thread of `start`, if it was not `shutdown`."""
        self._selector.register(self._wake, EVENT_READ, self._woken)
        self._selector.register(listener, EVENT_READ, self._accept)

    @property
    def address(self) -> tuple[str, int]:
        """Where it listens."""
        return self._host, self._port

    def start(self) -> None:
        """Serve on a thread of its own."""
        self._thread = threading.Thread(target=self._run, name="rotctld", daemon=True)
        self._thread.start()

    def serve_forever(self) -> None:
        """Serve on this thread until `shutdown`."""
        before = sys.getswitchinterval()
        sys.setswitchinterval(min(before, SWITCH_S))
        self._thread = self._thread or threading.current_thread()
        try:
            while not self._ending.is_set():
                self.step(LONGEST_WAIT_S)
        finally:
            sys.setswitchinterval(before)
            self._end()

    def shutdown(self) -> None:
        """End serving: hang up on all clients, and wait until that is done. Any thread."""
        self._ending.set()
        self._wake.set()
        if self._thread is None:
            self._end()
        elif self._thread is not threading.current_thread():
            self._ended.wait(END_S)

    def hang_up(self, number: int) -> None:
        """End the connection of a client (`NetworkClient.number`); its motion finishes. Any thread."""
        self._want(lambda: self._hang_up(number, HangUp.UNWANTED) if number in self._served else None)

    def shut_out(self, number: int, *, on: bool) -> None:
        """Ignore the wishes of a client, and end what it moves; or take them again. Any thread."""
        self._want(lambda: self._served[number].rotor.shut_out(on=on) if number in self._served else None)

    def recognise(self, *, on: bool) -> None:
        """Recognise which satellites clients follow, where this server can; or go by their own steps. Any thread."""
        if self._recogniser is not None:
            self._recogniser.on = on
            self._want(lambda: None)

    def _want(self, done: Callable[[], object]) -> None:
        self._wanted.append(done)
        self._wake.set()

    def wait(self, longest_s: float) -> bool:
        """Wait for the end of serving; return whether it has come. Any thread but the serving one."""
        return self._ended.wait(longest_s)

    def step(self, longest_s: float) -> None:
        """Serve what is due; wait for that so long at most."""
        now = self._clock.monotonic()
        due = min(self._tick(now), now + longest_s)
        for key, mask in self._selector.select(max(0.0, due - now)):
            key.data(mask)
        while self._done:
            self._serve(self._done.popleft(), ServedClient.resume)
        while self._wanted:
            self._stirred, self._dish_due = True, self._clock.monotonic()
            self._wanted.popleft()()
        self._publish(self._clock.monotonic())

    def _run(self) -> None:
        try:
            self.serve_forever()
        except BaseException as crash:
            log.exception("the server for network clients has failed")
            self.crash = crash

    def _tick(self, now: float) -> float:
        """Do what is due by time; return when there is more."""
        for number in [number for number, due in self._due.items() if due <= now]:
            self._serve(number, ServedClient.tick)
        if self._dish_due is not None and self._dish_due <= now:
            self._dish_due = self._dish.tick()
        if self._accepts_at is not None and self._accepts_at <= now:
            self._accepts_at = None
            self._selector.register(self._listener, EVENT_READ, self._accept)
        if self._settings.silent_s and self._look_at <= now:
            self._end_silence(now)
        moments = [*self._due.values(), now + LONGEST_WAIT_S]
        moments += [each for each in (self._dish_due, self._accepts_at) if each is not None]
        if self._stirred:
            moments.append(self._publish_at)
        if self._served:
            moments.append(self._look_at)
        return min(moments)

    def _end_silence(self, now: float) -> None:
        """Hang up on those who have said nothing for longer than is allowed."""
        latest = now - self._settings.silent_s
        for number in [each for each, it in self._served.items() if it.client.record.last_at <= latest]:
            self._hang_up(number, HangUp.SILENT)

    def _woken(self, _mask: int) -> None:
        self._wake.clear()

    def _accept(self, _mask: int) -> None:
        for _ in range(ACCEPTED_AT_ONCE):
            try:
                line, peer = self._listener.accept()
            except (BlockingIOError, InterruptedError, ConnectionAbortedError):
                return
            except OSError as error:  # no descriptor left
                log.warning("no client can be let in: %s", error)
                self._selector.unregister(self._listener)
                self._accepts_at = self._clock.monotonic() + FULL_S
                self._make_room()
                return
            self._stirred = True
            self._let_in(line, peer[0], peer[1])

    def _let_in(self, line: socket.socket, host: str, port: int) -> None:
        self._came += 1
        number, name = self._came, f"rotctld {self._came}"
        record = ClientRecord(number, name, f"[{host}]:{port}" if ":" in host else f"{host}:{port}", self._clock)
        why = None
        if not is_allowed(host, self._networks):
            why = HangUp.NOT_ALLOWED
        elif len(self._served) >= places(self._settings.most_clients) and not self._make_room():
            why = HangUp.FULL
        if why is not None:
            line.close()
            self._turned_away += 1
            self._tell(ClientNews(record.view(), why))
            return
        rotor = self._dish.client(name)
        try:
            client = ServedClient(
                line, rotor, record, self._limits, self._clock, lambda: self._answered(number),
                None if self._recorder is None else partial(self._recorder.note, number),
            )  # fmt: skip
        except OSError:  # it has hung up already
            rotor.leave()
            line.close()
            return
        self._served[number] = _Served(client, rotor)
        if self._recorder is not None:
            self._recorder.remark(number, f"connected from {record.address}")
        self._watch(number)
        self._tell(ClientNews(record.view()))

    def _make_room(self) -> bool:
        """Hang up on the client that has been silent longest; False where all have said something lately."""
        now = self._clock.monotonic()
        in_control = {view.name for view in self._dish.views() if view.role is ClientRole.CONTROL}
        free = [number for number, each in self._served.items() if each.client.record.name not in in_control]
        silent = min(free, key=lambda number: self._served[number].client.record.last_at, default=None)
        if silent is None or now - self._served[silent].client.record.last_at < SILENT_S:
            return False
        self._hang_up(silent, HangUp.SILENT)
        return True

    def _answered(self, number: int) -> None:
        """Note that the dish has answered a client. Any thread."""
        self._done.append(number)
        self._wake.set()

    def _ready(self, number: int, mask: int) -> None:
        if mask & selectors.EVENT_WRITE:
            self._serve(number, ServedClient.write)
        if mask & EVENT_READ:
            self._serve(number, ServedClient.read)

    def _serve(self, number: int, work: Callable[[ServedClient], None]) -> None:
        """Do a piece of work for a client. A fault of ours in it ends this client's connection, and no other's."""
        served = self._served.get(number)
        if served is None:
            return
        try:
            work(served.client)
        except Exception:  # whatever it is: it is told in the log, and the other clients are served on
            log.exception("a fault of birdcage ends the connection of %s", served.client.record.name)
            served.client.why = HangUp.FAULT
        self._stirred = True
        soon = self._clock.monotonic() + DISH_S
        self._dish_due = soon if self._dish_due is None else min(self._dish_due, soon)
        if served.client.why is not None:
            self._hang_up(number, served.client.why)
        else:
            self._watch(number)

    def _watch(self, number: int) -> None:
        """Wait for what this client's socket has to be ready for, and for what is due for it."""
        served = self._served[number]
        due = served.client.due
        if due is not None:
            self._due[number] = due
        elif self._due:
            self._due.pop(number, None)
        events = served.client.events
        if events == served.events:
            return
        if not events:
            self._selector.unregister(served.client)
        elif served.events:
            self._selector.modify(served.client, events, lambda mask: self._ready(number, mask))
        else:
            self._selector.register(served.client, events, lambda mask: self._ready(number, mask))
        served.events = events

    def _hang_up(self, number: int, why: HangUp) -> None:
        self._stirred = True
        served = self._served.pop(number)
        if served.events:
            self._selector.unregister(served.client)
        self._due.pop(number, None)
        name = served.client.record.name
        view = served.client.record.view(next((each for each in self._dish.views() if each.name == name), None))
        served.client.close()
        if self._recorder is not None:
            self._recorder.remark(number, f"gone: {why}")
        try:
            served.rotor.leave()
        except Exception:  # it may be why this client is hung up on; the others are served on
            log.exception("a fault of birdcage while %s left", name)
        self._tell(ClientNews(view, why))

    def _publish(self, now: float) -> None:
        """Show who is there, not too often."""
        if now < self._publish_at or not (self._stirred or now >= self._look_at):
            return
        pause_s = max(PUBLISH_S, len(self._served) * PUBLISH_EACH_S)
        self._stirred, self._publish_at, self._look_at = False, now + pause_s, now + max(pause_s, LOOK_S)
        wishes = {view.name: view for view in self._dish.views()}
        most = max(FEWEST_LINES, MOST_LINES // max(1, len(self._served)))
        records = [served.client.record for served in self._served.values()]
        state = NetworkState(
            self._host, self._port, self._settings.read_only, self._settings.strict,
            tuple(record.view(wishes[record.name], most) for record in records), self._turned_away,
            recognises=self._recogniser is not None and self._recogniser.on,
            recognises_why_not=THROUGH if self._recogniser is None else self._recogniser.lacks,
        )  # fmt: skip
        if state != self._shown:
            self._shown = state
            self._show(state)

    def _end(self) -> None:
        """End what clients move, hang up on all, and give everything back."""
        if self._ended.is_set():
            return
        for number, served in list(self._served.items()):
            with contextlib.suppress(RotctldError):  # there is no link: the dish can't be told
                served.rotor.stop()
            self._hang_up(number, HangUp.CLOSING)
        with contextlib.suppress(KeyError, ValueError):
            self._selector.unregister(self._listener)
        self._listener.close()
        if self._recogniser is not None:
            self._recogniser.close()
        self._selector.close()
        self._wake.close()
        self._show(None)
        self._ended.set()


def places(most: int) -> int:
    """Return how many clients may be connected: as set, and as the system's limit of open files allows."""
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return most
    soft, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return most if soft == resource.RLIM_INFINITY else max(1, min(most, soft - RESERVED))
