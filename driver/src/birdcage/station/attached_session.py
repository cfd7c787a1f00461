"""The station of another program, as the app has it: with the words of F5, and an end that stops nothing."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace

from birdcage.antenna.gate import MotionBounds, MotionGate
from birdcage.antenna.raw_limits import limited
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import wrap_360
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.rotator import machines
from birdcage.rotator.facts import CableTurn
from birdcage.rotator.raw import CommandDoc, RawLines
from birdcage.rotator.values import Position
from birdcage.rotator.verdict import Grade
from birdcage.station.attach_messages import WirePiece
from birdcage.station.attached import AttachedStation
from birdcage.station.control_client import find_owner, owners_folder
from birdcage.station.events import Event, LeaseChanged
from birdcage.station.menu_commands import MenuCommands
from birdcage.station.plan_outline import PlanOutline
from birdcage.station.pursuit_state import Phase
from birdcage.station.raw import CONSOLE, OTHER_CONSOLE, MenuCommand, TranscriptEntry, Verdict
from birdcage.station.requests import AcquireLease, ApplySettings, Connect, ListCommands, Raw, ReloadSettings, Request
from birdcage.station.session import farewell
from birdcage.station.state import MOVING, Activity, LinkPhase, StationState

MEET_S = 1.0
"""How long a program that has the port may take to say so, before the app begins without its answer."""
UNJUDGED = Verdict(Grade.MOVES, "This app does not know the dish's language.", listed=False)
"""What is said of a line to a dish whose language is not installed here."""


class AttachedFaceStation(AttachedStation):
    """Keeps `FaceStation`. What a raw line would do tells the language of the dish, which is installed here too."""

    def __init__(self, paths: Paths, port: str, *, by: str) -> None:
        super().__init__(paths, port, by=by)
        self._config_file = paths.config_file
        self._steered = self._talks = False
        """Whether what `on_wire` tells was sent by a pursuit; and whether it is this app that has the console."""
        self._shown: tuple[StationState, bool, StationState] | None = None
        """The last state, whether this app had the console, and the state as it is shown here."""
        self._spoken: str | None = None
        self._raw: RawLines | None = None
        self._menus = MenuCommands(None)
        self.subscribe(self._hear_lease, LeaseChanged)

    @property
    def state(self) -> StationState:
        """What is known now.

        A console that another program has is `OTHER_CONSOLE`: every program calls its own `CONSOLE`. A pursuit whose
        plan was told as an outline is left out, as nothing of it can be drawn; that the dish follows stays.
        """
        state, talks = super().state, self._talks
        if self._shown is None or self._shown[0] is not state or self._shown[1] is not talks:
            here = state
            if state.holder == CONSOLE and not talks:
                here = replace(here, holder=OTHER_CONSOLE)
            if state.pursuit is not None and isinstance(state.pursuit.plan, PlanOutline):
                here = replace(here, pursuit=None)
            self._shown = state, talks, here
        return self._shown[2]

    @property
    def followed(self) -> str:
        """What a pursuit follows, or is to follow: `follows NOAA 20`; empty without one."""
        pursuit = super().state.pursuit
        if pursuit is None or pursuit.phase is Phase.OVER:
            return ""
        return f"{'follows' if pursuit.phase is Phase.FOLLOWING else 'is to follow'} {pursuit.plan.aim.name}"

    @property
    def has_prompt(self) -> bool:
        """Whether the machine shows a prompt."""
        raw = self._language()
        return raw is not None and raw.has_prompt

    def judge(self, line: str) -> Verdict:
        """Say what a raw line would do in the dish's present menu, and which limit of the station it would break."""
        raw = self._language()
        return UNJUDGED if raw is None else judge_by_state(raw, line, self.state)

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line that went out at this prompt changes nothing but the menu."""
        raw = self._language()
        return raw is not None and raw.only_asks(line, prompt)

    def says_target(self, text: str) -> bool:
        """Return whether a line from the machine does nothing but say where it goes."""
        raw = self._language()
        return raw is not None and raw.says_target(text)

    def is_prompt(self, text: str) -> bool:
        """Return whether a line from the machine is a prompt and nothing else."""
        raw = self._language()
        return raw is not None and raw.is_prompt(text)

    def is_steering(self) -> bool:
        """Return whether a pursuit has sent what `on_wire` tells now: the station's program knows."""
        return self._steered

    def on_wire(self, listener: Callable[[TranscriptEntry], None]) -> Callable[[], None]:
        """Hear the wire of the station's program (`FaceSession.on_wire`)."""

        def hear(piece: WirePiece) -> None:
            self._steered = piece.steered
            listener(piece.entry)

        def end() -> None:
            self.hear_wire(None)

        self.hear_wire(hear)
        return end

    def commands(self, menu: str | None) -> tuple[MenuCommand, ...]:
        """Return the commands of a menu: the documented ones, and what the dish has told this app."""
        self._language()
        return self._menus.of(menu)

    def submit(self, request: Request) -> Future[object]:
        """Ask for something (`AttachedStation.submit`). Settings are read again by the station's program.

        CommandRefused for another port: the station's program has this one.
        """
        if isinstance(request, ApplySettings):
            return super().submit(ReloadSettings(str(self._config_file.absolute())))
        if isinstance(request, Connect) and request.port != self.state.port:
            return _refused(
                f"{self.via} has {self.state.port}. To use {request.port}, end that program and start this one again."
            )
        future = super().submit(request)
        if isinstance(request, AcquireLease | Raw | ListCommands) and request.holder == CONSOLE:
            # Answers and events come in their order: what is heard of the lease before this one is older.
            future.add_done_callback(self._took_console)
        if isinstance(request, ListCommands):
            future.add_done_callback(self._learn)
        return future

    def _took_console(self, future: Future[object]) -> None:
        self._talks = self._talks or future.exception() is None

    def _hear_lease(self, event: Event) -> None:
        if isinstance(event, LeaseChanged) and event.holder != CONSOLE:
            self._talks = False

    def _learn(self, future: Future[object]) -> None:
        self._language()
        if future.exception() is None and isinstance(found := future.result(), tuple):
            told = [command for command in found if command.told_by_dish]
            for menu in {command.menu for command in told}:
                here = [each for each in told if each.menu == menu]
                self._menus.learn(menu, [CommandDoc(menu, each.name, each.usage, each.help) for each in here])

    def _language(self) -> RawLines | None:
        """Return the language of the dish that is driven now; None where it has none, or that is not installed."""
        dish = self.state.dish
        firmware = None if dish is None else dish.firmware
        if firmware is not None and firmware != self._spoken:
            try:
                raw = machines.make(firmware).raw
            except KeyError:
                raw = None
            self._spoken, self._raw, self._menus = firmware, raw, MenuCommands(raw)
        return self._raw


class AttachedSession:
    """Keeps `FaceSession` over the program that has the port. The app's end stops nothing there."""

    def __init__(self, station: AttachedFaceStation) -> None:
        self.station, self.clock = station, station.clock
        self.crash: BaseException | None = None

    @property
    def via(self) -> str:
        """The program that drives the dish, or did last."""
        return self.station.via or "another program"

    @property
    def detached(self) -> bool:
        """Whether no program is attached to now."""
        return not self.station.is_attached

    def start(self) -> None:
        """Do nothing: it is attached already."""

    def on_wire(self, listener: Callable[[TranscriptEntry], None]) -> Callable[[], None]:
        """Hear the wire of the station's program, and of each one after it."""
        return self.station.on_wire(listener)

    def bar(self) -> bool:
        """Bar nothing: the station goes on."""
        return False

    def leave(self, by: str) -> None:
        """Stop nothing: the station goes on."""

    def close(self) -> str:
        """Detach, and return what goes on, and where the dish was seen last."""
        station = self.station
        state, is_attached = station.state, station.is_attached
        station.close()
        where = farewell(state.position, state.position_lost, None)
        if not is_attached:
            return f"{state.link.detail} It is unknown whether the dish moves. {where}"
        going = f"the dish {station.followed}" if station.followed else what_goes_on(state)
        return f"{self.via} goes on{f': {going}' if going else ''}. {where}"


def judge_by_state(raw: RawLines, line: str, state: StationState) -> Verdict:
    """Say what a raw line would do, as the station's own console does, from nothing but the state."""
    verdict = raw.judge(line, state.menu, homed=state.homed)
    gate = _gate_of(state)
    if gate is not None:
        verdict = limited(verdict, gate)
    if verdict.grade >= Grade.MOVES and not verdict.limit and state.motion_refused_because is not None:
        return replace(verdict, limit=state.motion_refused_because)
    return verdict


def _gate_of(state: StationState) -> MotionGate | None:
    """Return a gate with the limits in force, where the dish stands now; None for a dish without a direction."""
    dish, own, position = state.dish, state.alignment, state.position
    if dish is None or dish.no_direction or state.el_min_deg is None or state.el_max_deg is None:
        return None
    bounds = MotionBounds(
        el_min_deg=state.el_min_deg - own.el_offset_deg, el_max_deg=state.el_max_deg - own.el_offset_deg,
        cable_min_deg=state.cable_min_deg, cable_max_deg=state.cable_max_deg,
        sectors=tuple(own.sector_to_dish(*sector) for sector in state.no_go_sectors),
        az_offset_deg=own.az_offset_deg, el_offset_deg=own.el_offset_deg,
    )  # fmt: skip
    gate = MotionGate(dish, bounds)
    if position is not None and state.position_lost is None:
        reports_turn = dish.turn is CableTurn.REPORTED
        az_deg = wrap_360(position.dish_az_deg) if reports_turn else position.dish_az_deg
        gate.position, gate.cable_deg = Position(az_deg, position.dish_el_deg), position.cable_deg
    return gate


def what_goes_on(state: StationState) -> str:
    """Return what the dish is at, pursuits aside, as the rest of a sentence; empty while it rests."""
    if state.activity is Activity.HOMING:
        return "the dish homes"
    if state.tasks:
        return f"the dish carries out {state.tasks[0].kind}"
    motion = state.motion
    if state.raw_motion:
        return "a raw line may have set the dish in motion"
    if motion is not None:
        return f"the dish moves to AZ {motion.to_az_deg:.2f} EL {motion.to_el_deg:.2f}°"
    return "the dish moves" if state.activity in MOVING else ""


def attach_session(paths: Paths, port: str, by: str) -> AttachedSession | None:
    """Attach to the program that has the port; None where there is none, or only what a dead one has left.

    A program that has the port and does not answer is attached to as soon as it does: nothing else can have the port.
    """
    folder = owners_folder(paths)
    if find_owner(folder, port) is None:
        return None
    station = AttachedFaceStation(paths, port, by=by)
    until = station.clock.monotonic() + MEET_S
    while not station.wait_attached(0.02) and station.clock.monotonic() < until:
        gone = station.state.link.state is LinkPhase.LOST and find_owner(folder, port) is None
        if gone:
            station.close()
            return None
    return AttachedSession(station)


def _refused(words: str) -> Future[object]:
    future: Future[object] = Future()
    future.set_exception(CommandRefused(f"{words} Nothing was sent.", reason=Reason.BUSY))
    return future
