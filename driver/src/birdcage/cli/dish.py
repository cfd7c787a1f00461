"""A dish for the length of one command: opened, waited for, and never left moving by accident."""

from __future__ import annotations

import signal
import threading
import traceback
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial

import click

from birdcage.base.clock import Clock, RealClock
from birdcage.base.errors import BirdcageError, ConfigError, MotionRefused, NoReply, PositionUnknown
from birdcage.base.reason import Reason
from birdcage.base.signals import SignalListener
from birdcage.cli import exits
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.options import Wanted
from birdcage.cli.say import say
from birdcage.cli.station_command import CONFIRM_S, StationCommand
from birdcage.cli.which import with_firmware
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer
from birdcage.station.every_dish import EveryDish, do_each
from birdcage.station.holding import find_held
from birdcage.station.inhibitor import SleepInhibitor
from birdcage.station.known import list_firmwares
from birdcage.station.network_state import NetworkState
from birdcage.station.requests import Watch
from birdcage.station.services import Services
from birdcage.station.session import Session
from birdcage.station.state import LinkPhase, StationState
from birdcage.station.station import Station

LEAVE_S = 12.0
"""How long the end of a command may take after a signal, the confirmation of STOP included; then it is ended hard."""
SURVEY_S = 10.0
"""Where no mark is echoed the line counts as quiet 4 s after it was opened; a survey takes less than two."""

READ_S = 5.0
"""How long to wait for the first reading of the position."""


class DishSession(StationCommand):
    """The session of one command, on a port of its own. A signal sends STOP first."""

    station: Station

    def __init__(self, session: Session, *, moves: bool) -> None:
        self.session = session
        self.services = Services()
        """What programs that are attached to this one can join."""
        super().__init__(session.station, moves=moves)

    @property
    def crash(self) -> BaseException | None:
        """What has ended the station's thread, if something has."""
        return self.session.crash

    def on_signal(self, number: int) -> None:
        """STOP before anything else; the wait under way ends afterwards. On the thread of the signals."""
        if self.moves and not self.closing:
            # Ctrl+C on a dish that moves is a person's STOP; any other signal ends the program, and that stops it.
            person = number == signal.SIGINT and self.station.bar()
            self.call_stop("Ctrl+C" if person else signal.Signals(number).name, leaving=not person)
        self.end_wait(number)

    def bar(self) -> None:
        """Let no line out that moves the dish from now on."""
        self.station.bar()

    def call_stop(self, by: str, *, leaving: bool = False) -> None:
        """STOP: its bytes are out when this returns. `leaving`: the dish is not held for other programs."""
        self.station.stop(by, leaving=leaving)
        self.stop_called = True

    def survey(self) -> None:
        """Wait until the dish has told its limits and settings, which it is asked once the line is proven quiet."""
        deadline = self.now + SURVEY_S
        self.station.submit(Watch("birdcage", frozenset({"position"})))
        while not self.state.surveyed and self.now < deadline and self.state.link.state is LinkPhase.UP:
            self.progress.show("Reading the dish's settings …")
            self.look()
        self.progress.clear()

    def show_network(self, network: NetworkState | None) -> None:
        """Show a server for network clients in the station."""
        self.station.show_network(network)

    def let_go(self) -> str:
        """Give the port back, and return where the dish is left."""
        return self.session.close(leave_moving=self.leave_moving)


def why_unknown(state: StationState) -> str:
    """Return why it is not known where the dish points, and what helps."""
    if state.dish is not None and state.dish.no_direction:
        return state.dish.no_direction
    if state.awaits_first_move:
        return (
            "This dish does not tell where it points. While `birdcage station run` is running, `birdcage move AZ EL` "
            "sends it somewhere, and that is remembered."
        )
    if state.awaits_sync and state.dish is not None:
        return f"The {state.dish.name} does not know where it points. {state.dish.must_be_synced}"
    if state.position_text:
        return f"{state.position_text} {how_to_home(state)}"
    return f"The dish is not homed, so it does not know where it points. {how_to_home(state)}"


def need_position(dish: StationCommand, lacking: str = "Nothing is followed.") -> None:
    """Wait until it is known where the dish points. PositionUnknown, what is `lacking`, and why, where it is not.

    MotionRefused of a machine that follows nothing.
    """
    facts = dish.state.dish
    if facts is not None and facts.no_following:
        raise MotionRefused(f"{facts.no_following} Nothing was sent.", reason=Reason.UNSUPPORTED)
    deadline = dish.now + READ_S
    while dish.state.position is None and dish.state.homed is not False and dish.now < deadline:
        if dish.state.awaits_first_move:
            break
        dish.look()
    if dish.state.position is None or dish.state.position_lost is not None:
        raise PositionUnknown(f"{lacking} {why_unknown(dish.state)}", reason=Reason.UNHOMED)


def how_to_home(state: StationState) -> str:
    """Return what makes a dish know where it is, in a sentence."""
    if state.dish is not None and state.dish.must_be_synced:
        return "Sync it: `birdcage sync AZ EL` says where it points."
    if state.dish is not None and state.dish.never_homes:
        return "It has no homing."
    if state.dish is not None and state.dish.homing_s is None:
        return "It homes only at power-up. Switch it off and on, and wait with `birdcage init`."
    return "`birdcage home` homes it."


@contextmanager
def open_dish(
    wanted: Wanted, *, moves: bool = False, survey: bool = True, clock: Clock | None = None
) -> Iterator[DishSession]:
    """Open the dish for one command, and close it whatever happens.

    `moves`: the command may move the dish, so a signal or an error sends STOP before the port is closed, and a last
    line says where the dish is. `clock`: another one than the wall's, for a simulated dish. Without a named
    firmware, the port is asked first. ConfigError for a firmware that this version does not speak.
    """
    with open_dishes((wanted,), moves=moves, survey=survey, clock=clock) as (dish,):
        yield dish


@contextmanager
def open_dishes(
    wanted: Sequence[Wanted], *, moves: bool = False, survey: bool = True, clock: Clock | None = None
) -> Iterator[tuple[DishSession, ...]]:
    """Open several dishes as `open_dish` does one. What ends the command ends all, and STOP reaches all at once."""
    wants = [with_firmware(each, clock=clock) for each in wanted]
    dishes = tuple(DishSession(_session(each, clock or RealClock(), survey=survey), moves=moves) for each in wants)
    with ExitStack() as stack:
        signals = take_signals(stack, *dishes)
        begun = [dish.now for dish in dishes]
        for dish, each in zip(dishes, wants, strict=True):
            if not each.port.startswith("sim:"):
                control = ControlServer(
                    dish.station, owners_folder(each.paths), _program(), dish.session.on_wire, dish.services
                )
                stack.callback(control.close)
            if moves:
                stack.callback(SleepInhibitor(dish.station).close)
            dish.session.start()
        try:
            try:
                yield dishes
            finally:
                if signals is not None:
                    signals.leave(LEAVE_S * len(dishes))
        except (BirdcageError, EndedBySignal, click.ClickException) as error:
            _leave_all(dishes, begun, error, wants)
            if isinstance(error, NoReply) and not wants[0].firmware_given:
                error.add_note(
                    f"Firmware unknown, so {wants[0].firmware} was tried. `birdcage detect` shows the answer at "
                    "each speed. Name the firmware with --firmware."
                )
            raise
        except BaseException as crash:
            stops = [partial(dish.call_stop, "a fault of birdcage") for dish in dishes if moves]
            do_each([
                *stops, partial(traceback.print_exception, crash), partial(_leave_all, dishes, begun, crash, wants)
            ])  # fmt: skip
            for line in crash.__notes__:
                say(line)
            raise click.exceptions.Exit(exits.CRASH) from crash
        else:
            _bar(dishes)
            do_each([dish.close for dish in dishes])


def _program() -> str:
    """Return how this command is called in other programs: `birdcage station run`."""
    context, words = click.get_current_context(silent=True), list[str]()
    while context is not None and context.parent is not None:
        words.insert(0, context.info_name or "")
        context = context.parent
    return " ".join(["birdcage", *words])


def leave_dish(dish: StationCommand, begun: float, error: BaseException, wanted: Wanted) -> None:
    """Stop what moves, and close. What is to be said after the error itself goes into its notes."""
    _leave_all((dish,), (begun,), error, (wanted,))


def _bar(dishes: Sequence[StationCommand]) -> None:
    """Let nothing begin to move any more, in no dish, before the first is closed: that may take seconds."""
    for dish in dishes:
        if dish.moves and not dish.leave_moving:
            dish.bar()


def _leave_all(
    dishes: Sequence[StationCommand], begun: Sequence[float], error: BaseException, wants: Sequence[Wanted]
) -> None:
    """STOP whatever moves, all of it before the first is waited for; then close each."""
    error.__notes__ = []

    def stop(dish: StationCommand, since: float) -> None:
        if dish.moves and dish.in_motion and not dish.stop_called and dish.stopped_since(since) is None:
            dish.call_stop("birdcage", leaving=True)

    def close(dish: StationCommand, since: float, wanted: Wanted) -> None:
        for note in _left(dish, since, error, wanted):
            error.add_note(note if len(dishes) == 1 else f"{dish.state.port or wanted.port}: {note}")

    do_each([
        *(partial(stop, dish, since) for dish, since in zip(dishes, begun, strict=True)),
        partial(_bar, dishes),
        *(partial(close, *each) for each in zip(dishes, begun, wants, strict=True)),
    ])  # fmt: skip


def _left(dish: StationCommand, begun: float, error: BaseException, wanted: Wanted) -> Iterator[str]:
    """Wait for what came of STOP, close, and yield what is to be said of it."""
    stopped = dish.stop_called or dish.stopped_since(begun) is not None
    if stopped:
        report = dish.settle(begun, leaving=True) or dish.stopped_since(begun)
        if report is not None:
            yield report.sentence
            if report.confirmed is None and report.means != "nothing moved":
                yield f"STOP is not confirmed after {CONFIRM_S:.0f} s. Look at the dish, or cut its power."
    farewell = dish.close()
    held = find_held(wanted.paths, dish.state.port or wanted.port)
    if held is not None and held.note.sentence not in str(error):
        yield f"{held.note.sentence} `birdcage release` lets it move again."
    if stopped or isinstance(error, EndedBySignal):
        yield farewell


def _session(wanted: Wanted, clock: Clock, *, survey: bool) -> Session:
    from birdcage.diagnostics.motor_test_records import MotorTestBook
    from birdcage.diagnostics.motor_test_task import MotorTests
    from birdcage.signal.source_set import SourceSet
    from birdcage.skymap.map_keeper import MapKeeper
    from birdcage.skymap.map_task import map_tasks
    from birdcage.station.build import open_session

    known = list_firmwares()
    if wanted.firmware not in known:
        raise ConfigError(
            f"This version does not speak {wanted.firmware}. It speaks {', '.join(known)}. Without --firmware, "
            "BIRDCAGE_FIRMWARE and dish.firmware the port is asked."
        )
    sources = SourceSet(wanted.settings, clock, wanted.load, memory=wanted.paths.found_directions)
    maps = MapKeeper(sources, wanted.paths.signal_recordings, wanted.settings)
    motors = MotorTests(MotorTestBook(wanted.paths.journal))

    def close() -> None:
        sources.close_meters()
        motors.book.close()
        if motors.book.problem:
            say(motors.book.problem)

    session = open_session(
        port=wanted.port, firmware=wanted.firmware, baud=wanted.baud, settings=wanted.settings, paths=wanted.paths,
        clock=clock, survey=survey, load=wanted.load, tasks={**sources.tasks, **map_tasks(maps), **motors.tasks},
        on_close=close,
    )  # fmt: skip
    sources.attach(session.station)
    maps.attach(session.station)
    motors.attach(session.station)
    return session


def take_signals(stack: ExitStack, *dishes: StationCommand) -> SignalListener | None:
    """Hear signals for a command, until the stack is left; None off the main thread, which alone can.

    STOP goes to all of its dishes at once.
    """
    if threading.current_thread() is not threading.main_thread():
        return None  # only the main thread can; a program that runs commands elsewhere keeps its own handlers
    signals = SignalListener()
    stack.callback(signals.close)
    every = EveryDish(len(dishes))
    stack.callback(every.close)

    def hear(number: int) -> None:
        every.do([partial(dish.on_signal, number) for dish in dishes])

    def last() -> None:
        # Without a word: it is a terminal that takes none which keeps the main thread. Once each: STOP has gone out.
        do_each([dish.let_go for dish in dishes])

    signals.tell(hear, last)
    signals.start()
    return signals
