"""The one owner of the dish: a step function over an injected clock (`docs/architecture.md`, *Threads*)."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.config import AntennaConfig
from birdcage.antenna.odometer import AxisWay
from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError, LinkError, NoReply, Stopped
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.rotator import machines
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.own import laid_by_owner
from birdcage.station.after_reboot import AfterReboot
from birdcage.station.applying import Applying
from birdcage.station.connection import Connection
from birdcage.station.control import Control
from birdcage.station.dish_monitor import DishMonitor
from birdcage.station.dish_mover import DishMover
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import Event
from birdcage.station.inbox import Inbox, WaitingRequest
from birdcage.station.memories import Memories
from birdcage.station.network_state import NetworkState
from birdcage.station.parts import Parts
from birdcage.station.pursuit_state import Phase
from birdcage.station.raw import MenuCommand, Verdict
from birdcage.station.raw_console import RawConsole
from birdcage.station.raw_effects import RawEffects
from birdcage.station.request_handler import RequestHandler
from birdcage.station.request_log import log_request
from birdcage.station.requests import Request
from birdcage.station.rewire import Rewire
from birdcage.station.saved_speeds import SavedSpeeds
from birdcage.station.settings import StationSettings
from birdcage.station.settings_backup import SettingsBackup
from birdcage.station.signals import Signals
from birdcage.station.state import MOVING, LinkPhase, StationState
from birdcage.station.state_store import Listener, StateStore, StateWatcher
from birdcage.station.stop_pending import StopReach
from birdcage.station.stopper import Stopper
from birdcage.station.tasks.host import TaskHost
from birdcage.station.tasks.kept import TaskFile
from birdcage.station.unattended import UnattendedGuard
from birdcage.station.watches import Watches

NO_FLOOR_DEG = -90.0
"""A floor of the caller's own is for scripts; the station has the limits of the dish and of the settings."""
LOOK_AT_CLOCK_S = 1.0
"""How often a suspend or a step of the clock is looked for."""


class Station:
    """Requests in, events and a state out. `submit`, `stop`, `state` and `subscribe` are for any thread.

    Everything else belongs to the thread that calls `step`.
    """

    @classmethod
    def adopt(cls, antenna: BirdcageAntenna, clock: Clock, settings: StationSettings) -> Station:
        """Return a station for an antenna that a script has made; from `begin` on it alone may call that.

        Calls from other threads then raise `WrongThread`. A port that is open is closed here, and opened anew by the
        station, which has to hear all that the dish says. The antenna's floor stays; the rules are those of `settings`.
        """
        antenna.disconnect()
        return cls(clock, settings, antenna)

    def __init__(self, clock: Clock, settings: StationSettings, antenna: BirdcageAntenna | None = None) -> None:
        """Without an `antenna`, one for `settings.firmware` is made."""
        if antenna is None:
            config = AntennaConfig(settings.port, min_elevation=NO_FLOOR_DEG, leapfrog_enabled=False)
            antenna = BirdcageAntenna(machines.make(settings.firmware), config, settings.alignment)
        rotator = antenna.rotator
        own_facts, wrong_facts = laid_by_owner(rotator.facts, settings.own_facts)
        if settings.own_facts:
            rotator.facts = antenna.gate.model = own_facts
            antenna.know(antenna.own)
        self.clock, self.settings, self._antenna = clock, settings, antenna
        antenna.be_permitted_by(self._permit)
        antenna.doubt()
        state = StationState(
            port=settings.port, dish=rotator.facts, turn=rotator.facts.turn, unplanned_stop=antenna.strategy.unplanned
        )
        self._store = store = StateStore(clock, state)
        self._wake, self._inbox, self._closing = Wake(), Inbox(), threading.Event()
        self._shutting = False
        """Whether what is said to the dish now is what has to be said before the end."""
        signals = Signals()
        self._control = control = Control(store, signals, settings.held_keeper)
        self._reader = reader = DishReader(store, antenna, settings, signals)
        self._mover = mover = DishMover(store, antenna, reader, signals)
        self._stopper = stopper = Stopper(store, antenna, control, mover, reader)
        self._watches = watches = Watches()
        self._unattended = guard = UnattendedGuard(store, settings.not_now)
        backup = SettingsBackup(store, antenna, settings.backup_folder)
        parts = Parts(store, antenna, settings, signals, control, reader, mover, stopper, watches, guard, backup)
        self._memories = Memories(store, antenna, reader, signals, settings)
        applying = Applying(parts, wrong_facts)
        applying.use(settings)
        file = TaskFile(settings.state_folder, settings.port, settings.firmware, settings.tasks)
        self._host = TaskHost(parts, file)
        self._after_reboot = AfterReboot(parts, self._host)
        if settings.state_folder is not None:
            self._host.speeds.remember(SavedSpeeds(settings.state_folder, settings.port, settings.firmware))
        self._hosted = False
        """Whether the last piece of work was a task's: then a request has its turn."""
        self._monitor = monitor = DishMonitor(parts)
        self._connection = Connection(
            store, antenna, settings, reader, signals,
            Hooks(
                dial=settings.open_link, site=settings.site, delay_s=settings.delay_s, permit=antenna.check_permit,
                wake=self._wake, on_wake=self._on_wake, on_line=monitor.on_line, on_restart=monitor.restarted,
                on_trouble=monitor.troubled, on_look=monitor.heard_position, on_facts=reader.learn, on_busy=mover.busy,
                on_prompt=monitor.boot_log.ended, on_recount=signals.restarted,
            ),
        )  # fmt: skip
        rewire = Rewire(parts, self._connection, monitor, self._wake, self._on_wake)
        effects = RawEffects(store, antenna, mover, settings.remark, monitor.restarted)
        self._raw_console = RawConsole(parts, monitor, effects, self._permit)
        self._handler = RequestHandler(parts, rewire, self._raw_console, applying, self._host)

    @property
    def state(self) -> StationState:
        """What is known now: immutable. Any thread."""
        return self._store.state

    @property
    def asked_port(self) -> str:
        """The port as it was last asked for; `state.port` is where it is now. Any thread."""
        return self._connection.asked_port

    def subscribe(self, listener: Listener, *kinds: type[Event]) -> Callable[[], None]:
        """Hear these events, all by default, on the station's thread: do nothing slow. Returns what ends it."""
        return self._store.subscribe(listener, *kinds)

    def watch(self, watcher: StateWatcher) -> Callable[[], None]:
        """Call `watcher` with the present state and each new one (`StateStore.watch`); the result ends that."""
        return self._store.watch(watcher)

    def on_way(self, listener: Callable[[AxisWay], None]) -> None:
        """Tell `listener`, on the station's thread, how far each axis is sent. One listener."""
        self._antenna.odometer.on_way = listener

    def submit(self, request: Request) -> Future[object]:
        """Ask for something. The future holds its result, or a `BirdcageError` that says why not. Any thread."""
        future: Future[object] = Future()
        log_request(request, future)
        self._inbox.append(WaitingRequest(request, future, self._stopper.count))
        self._wake.set()
        if self._closing.is_set():
            self._inbox.drop()
        return future

    def judge(self, line: str) -> Verdict:
        """Say what a raw line would do in the dish's present menu, before it is sent. Sends nothing; any thread."""
        return self._raw_console.judge(line)

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line that went out at this prompt changes nothing but the menu. Any thread."""
        raw = self._antenna.raw
        return raw is not None and raw.only_asks(line, prompt)

    def says_target(self, text: str) -> bool:
        """Return whether a line from the machine does nothing but say where it goes. Any thread."""
        raw = self._antenna.raw
        return raw is not None and raw.says_target(text)

    def is_prompt(self, text: str) -> bool:
        """Return whether a line from the machine is a prompt and nothing else. Any thread."""
        raw = self._antenna.raw
        return raw is not None and raw.is_prompt(text)

    @property
    def has_prompt(self) -> bool:
        """Whether the machine shows a prompt; without one its console is a plain line terminal. Any thread."""
        raw = self._antenna.raw
        return raw is not None and raw.has_prompt

    def is_steering(self) -> bool:
        """Return whether a pursuit sends what goes out now, and not STOP or another holder. Any thread."""
        live = self.state.pursuit
        following = live is not None and live.phase is Phase.FOLLOWING and self.state.holder == live.holder
        return following and not self._control.latched

    def commands(self, menu: str | None) -> tuple[MenuCommand, ...]:
        """Return the commands of a menu: the documented ones, and what the dish has told. Any thread."""
        return self._raw_console.menus.of(menu)

    def stop(self, by: str, *, leaving: bool = False) -> None:
        """STOP: its first bytes are on their way when this returns. Any thread; never waits for the dish.

        A program that is `leaving` does not hold the dish for those that come after.
        """
        self._stopper.call(by, leaving=leaving)
        self._wake.set()

    def warn(self, subject: str, sentence: str) -> None:
        """Keep what a person should know of this program itself, one sentence a subject; empty: no more. Any thread."""
        self._store.warn(subject, sentence)

    def own_signal(self, source: str, holder: str) -> None:
        """Show who owns a signal source now: a target, or `monitor`; empty: it is free. Any thread."""
        self._store.own_signal(source, holder)

    def show_network(self, network: NetworkState | None) -> None:
        """Show the server for network clients, and who they are; None: it has ended. Any thread."""
        self._store.change(network=network)

    @property
    def stop_reach(self) -> StopReach:
        """Whether the last STOP got through to the dish. Any thread."""
        return self._stopper.reach

    def bar(self) -> bool:
        """Let no line out that moves the dish from now on; return whether it may be moving. Any thread."""
        self._control.latched = True
        # In this order: what was let through before has its model, so that STOP can aim.
        state = self.state
        return state.raw_motion or state.activity in MOVING or self._antenna.motion is not None

    def begin(self) -> None:
        """Open the link as soon as the loop turns."""
        self._antenna.adopt(threading.current_thread())
        self._connection.begin()

    def end(self) -> None:
        """Make the loop return soon. Any thread."""
        self._closing.set()
        self._wake.set()

    @property
    def is_ending(self) -> bool:
        """Whether `end` was called."""
        return self._closing.is_set()

    def step(self, until: float) -> None:
        """Work until the monotonic time `until`, or until `end`."""
        while not self._closing.is_set():
            self._notice()
            now = self.clock.monotonic()
            due, work = self._next(now)
            if due <= now:
                self._hosted = work == self._host.tick
                self._guard(work)
            if now >= until:
                return
            if due > now:
                self._guard(partial(self._listen, min(due, until, now + LOOK_AT_CLOCK_S)))

    def _listen(self, until: float) -> None:
        """Wait; take in what comes unasked."""
        rotator = self._antenna.rotator
        if rotator.is_open:
            rotator.listen(until)
        else:
            self.clock.wait(None, until, self._wake)

    def shut(self) -> None:
        """Stop what moves, answer everybody, give the port back. On the station's thread, after the loop."""
        self._closing.set()
        self._inbox.drop()
        self._shutting = True
        try:
            self._host.shut()
            self._mover.fail(*self._handler.ending())
            self._raw_console.line.shut()
        finally:
            try:
                self._connection.close()
            finally:
                self._memories.close()
                self._antenna.adopt(None)
                self._wake.close()

    def _next(self, now: float) -> tuple[float, Callable[[], None]]:
        """Return the next piece of work, and when it is due: of what is due now, what ranks highest.

        In this order: STOP, link, motion, tasks, requests, then looking. A request goes first after a task's work.
        """
        link_is_up = self._store.state.link.state is LinkPhase.UP
        ranked: list[tuple[float | None, Callable[[], None]]] = []
        if self._raw_console.holder is not None:  # before STOP's follow-up, which needs the console
            ranked.append((self._raw_console.due(), self._raw_console.tick))
        ranked += [(self._stopper.due, self._follow_stop), (self._connection.due, self._connect)]
        if link_is_up:
            ranked += [
                (now if self._host.restore_due else None, self._host.restore),
                (self._mover.due, self._mover.tick),
            ]
        ranked.append((self._control.due, self._control.tick))
        if self.settings.not_now is not None:
            guard_due = self._unattended.due(now, moves=self._host.moves_unattended)
            ranked.append((guard_due, self._handler.ask_guard))
        if self.settings.home_after_reboot:
            ranked.append((self._after_reboot.due(now), self._after_reboot.tick))
        task, request = (self._host.due(now), self._host.tick), (now if self._inbox else None, self._serve_next)
        ranked += [request, task] if self._hosted else [task, request]
        due, work = math.inf, self._monitor.tick
        for at, each in ranked:
            if at is not None and max(at, now) < due:
                due, work = max(at, now), each
        if due > now and link_is_up:
            look_at = self._monitor.due(now)
            if look_at is not None and look_at < due:
                due, work = look_at, self._monitor.tick
        return due, work

    def _follow_stop(self) -> None:
        self._stopper.tick()
        if self._connection.was_answered():
            self._monitor.met()

    def _connect(self) -> None:
        if self._connection.attempt():
            self._monitor.met()

    def _serve_next(self) -> None:
        request, future, stops_seen = self._inbox.popleft()
        if not future.set_running_or_notify_cancel():
            return
        try:
            self._handler.serve(request, future, stops_seen)
        except LinkError as error:
            self._fail(future, error)
            if self._connection.is_up:  # else it is the answer that there is none
                self._link_gone(error)
        except BirdcageError as error:
            self._fail(future, error)
            self._monitor.hear_refusal(error)
            if isinstance(error, NoReply) and error.reason != Reason.NO_ROW:
                self._monitor.interrupted(HeldReason.LINK)
                self._connection.silent(error)
        except BaseException:
            if not future.done():
                future.set_exception(Stopped("The station has failed.", reason=Reason.CLOSING))
            raise

    @staticmethod
    def _fail(future: Future[object], error: BirdcageError) -> None:
        if not future.done():  # else STOP has answered it in the middle of the exchange
            future.set_exception(error)

    def _guard(self, work: Callable[[], object]) -> None:
        """Do work on the wire; a lost link or a silent dish is a state, not the end."""
        try:
            work()
        except LinkError as error:
            self._link_gone(error)
        except Stopped:
            pass  # STOP or the end of the station cut the exchange short; both have their own follow-up
        except BirdcageError as silence:
            if self._monitor.hear_refusal(silence):
                return
            # No answer, or one that makes no sense here: find out where the console is.
            self._monitor.interrupted(HeldReason.LINK)
            self._connection.silent(silence)
        finally:
            self._note()

    def _link_gone(self, error: LinkError) -> None:
        self._monitor.interrupted(HeldReason.LINK)
        self._connection.lost(error)

    def _note(self) -> None:
        if self._antenna.is_connected:
            self._connection.note_reply()

    def _notice(self) -> None:
        """Take STOPs and look at the clock."""
        self._wake.clear()
        if self._control.latched:  # as it is before a STOP counts as called
            self._stopper.take_calls()
        self._monitor.check_clock()
        if self._control.latched:
            self._host.stopped()

    def _on_wake(self) -> None:
        """Notice what happened in the middle of an exchange; end it when the station ends."""
        self._notice()
        if self._closing.is_set() and not self._shutting:
            raise Stopped("The station ends.", reason=Reason.CLOSING)

    def _permit(self) -> None:
        """Keep a line that moves the dish from going out once STOP is latched."""
        # In this order: a STOP that latches from now on finds the line let out, though it may just have been kept.
        self._antenna.moving.is_kept = False
        if self._control.latched:
            raise Stopped("STOP is latched: the motion was not sent.")
