"""What every dialect can do: the abstract class of `docs/reference/published-interface.md`."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, ClassVar, NoReturn, Unpack

from birdcage.base.clock import Clock, RealClock
from birdcage.base.errors import BelowFloor, BirdcageError, CommandRefused, LinkError, MotionRefused
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.session import Console
from birdcage.console.session_hooks import SessionHooks
from birdcage.protocol.family import angle_text
from birdcage.protocol.generic import GENERIC_DIALECT, GENERIC_FACTS, GENERIC_FEATURES, position_in
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.raw_aim import aimed
from birdcage.protocol.unhomed import unreadable
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import OwnSettings
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.readings import settled
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import (
    MOTOR_AZIMUTH,
    MOTOR_ELEVATION,
    MOTOR_SKEW,
    Position,
    RssiReading,
    Survey,
    Taken,
)
from birdcage.rotator.verdict import Grade, Verdict

if TYPE_CHECKING:
    from birdcage.link.link import Link

BOOT_TIMEOUT_S = 180.0
LIMIT_REASONS = {MOTOR_AZIMUTH: Reason.AZ_LIMIT, MOTOR_ELEVATION: Reason.EL_LIMIT, MOTOR_SKEW: Reason.SKEW_LIMIT}
STALLED = re.compile(r"\bSTALLED\b")
"""An obstacle, which is said of the motion under way and not of the question."""


def _nothing(*_: object) -> None:
    pass


TARGET = re.compile(r"\s*[A-Za-z]+(\[\d\])?\s*=\s*[-+]?\d+(\.\d+)?\s*$")
"""How a dish says where it goes."""


class FirmwareProtocol(ABC):
    """Speaks one firmware's console. Synchronous, blocking, not thread-safe, except for `interject`.

    A subclass must say how to `initialize`, `enter_motor_menu` and `kill_search`. All else does what the consoles of
    this family have in common, and may be said better: `model` and `dialect` first, or `connect`, `get_position` and
    `move_motor` by a class with a port of its own.

    Angles are degrees in the dish's own frame. Every method that talks raises `LinkError` when the port is gone,
    `NoReply` when the dish does not answer in time, and `CommandRefused` when the firmware answers with an error.
    """

    name: ClassVar[str] = GENERIC_FACTS.firmware
    model: Facts = GENERIC_FACTS
    dialect: ClassVar[ConsoleDialect] = GENERIC_DIALECT
    boot_marks: ClassVar[tuple[str, ...]] = ()
    """Words in unasked lines that mean that the dish has just started."""
    log_marks: ClassVar[tuple[str, ...]] = ()
    """Words of its boot log that no other console is known to print: they tell which firmware it is."""
    motor_menu: ClassVar[str] = "mot"
    """Where motions, and the lines that stop them, are understood."""
    feature_table: ClassVar[FeatureTable] = GENERIC_FEATURES
    """What it tells and lets be set besides its position; `model` has the same (`features=TABLE.features`)."""
    hazards: ClassVar[HazardTable] = HazardTable()
    """What raw lines do. Without rows, each counts as changing a setting."""
    commands: ClassVar[tuple[CommandDoc, ...]] = ()
    """The documented commands of each menu."""
    help_lines: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    """What brings the help of a menu page by page, where that is not a single `?`."""

    @property
    def own_settings(self) -> OwnSettings | None:
        """The settings that it keeps itself; None where no command is known that changes them."""
        return None

    _link: Link | None = None
    _console: Console | None = None
    _was_inside = False
    """Whether the dish was last seen in a menu that nothing is known to leave; across lost links, too."""
    printed_deg: float = 0.01
    """How fine the angles are that the dish prints, as its last reading showed."""
    on_busy: Callable[[], None] = staticmethod(_nothing)
    """Told when the dish leaves the command of a move unanswered, and may be waiting for a motor that runs."""
    on_restart: Callable[[str], None] = staticmethod(_nothing)
    """Told, in words, that the dish shows to have restarted."""
    on_facts: Callable[[Facts], None] = staticmethod(_nothing)
    """Told what the dish has shown that it is, where that differs from `model`: within `meet` alone."""
    permit: Callable[[], None] | None = None
    """Asked, with writing locked, just before a line that moves the dish; raises to keep it from going out."""

    @property
    def console(self) -> Console:
        """The open console; LinkError when there is none."""
        if self._console is None:
            raise LinkError("The dish is not connected. Connect first.", reason=Reason.CLOSED)
        return self._console

    @property
    def clock(self) -> Clock:
        """The clock of the open console."""
        return self.console.clock

    @property
    def is_connected(self) -> bool:
        """Whether a port is open."""
        return self._console is not None

    def connect(self, port: str, baudrate: int = 57600) -> None:
        """Open the port (8N1) exclusively. LinkError says what is wrong and what to do."""
        from birdcage.link.opening import open_link

        clock = RealClock()
        self.attach(open_link(port, baud=baudrate, clock=clock), clock)

    def attach(self, link: Link, clock: Clock, **hooks: Unpack[SessionHooks]) -> None:
        """Speak over an open link. Sends nothing.

        `delay_s` is the longest that an answer may be on its way; `wake` ends waits early and then calls `on_wake`,
        which may raise to abandon the exchange; `on_line` hears unsolicited lines, `on_prompt` each prompt.
        """
        self._link = link
        self._console = Console(link, clock, self.dialect, **hooks)
        self._console.hear_busy(self.on_busy)
        self._console.hear_ends(self._is_at_end, self._is_back)

    def _is_at_end(self, menu: str) -> None:
        """Take in where the dish stands: back at its root from a menu that nothing leaves, it has restarted."""
        inside = menu in self.dialect.one_way
        if self._was_inside and not inside:
            self.on_restart(f"The dish is back in menu `{menu}`: only a restart is known to lead there.")
        self._was_inside = inside

    def _is_back(self, menu: str) -> None:  # noqa: B027 - most show in other ways that they have restarted
        """Take in that it is back at its root, and that nothing was sent that leads there."""

    def disconnect(self, *, within_s: float = 2.0) -> None:
        """Go back to the root menu where that is safe within a time (0: send nothing), and close the port.

        Never raises for a port that is gone.
        """
        link, console = self._link, self._console
        self._link = self._console = None
        if link is None or console is None:
            return
        try:
            if within_s > 0:
                console.leave_all(within_s)
        except BirdcageError:
            # A dish that no longer answers stays in its menu; the port is closed all the same.
            return
        finally:
            link.close()

    def meet(self) -> None:
        """Find out whether it answers, and tell `on_facts` what it then shows of itself. NoReply says what came."""
        self.console.synchronize()

    def reset_to_root(self) -> None:
        """Leave submenus until the root prompt shows, or one that nothing is known to leave.

        `q` is sent from a proven submenu only.
        """
        self.console.leave()

    @abstractmethod
    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = BOOT_TIMEOUT_S) -> None:
        """Wait for the end of the boot, then make sure of the motor menu. `callback` hears status lines."""

    @abstractmethod
    def enter_motor_menu(self) -> None:
        """Go into the motor menu; nothing is sent when the dish is there already."""

    def get_position(self) -> Position:
        """Read where the dish is. PositionUnknown when the axes are not homed, or it says twice what is no position."""
        return settled(self.read_position)

    def read_position(self, *, busy_s: float = 0.0) -> Position:
        """Ask once where the dish is; `busy_s`: how long a move may keep it from answering.

        UnreadablePosition for an answer that is no position: it may be damaged, and `get_position` asks once more.
        """
        try:
            return self._read_position(busy_s)
        except CommandRefused as refused:
            self._tell_unread(refused)

    def _read_position(self, busy_s: float) -> Position:
        """Ask `a` once in the motor menu, and read either form that this family prints."""
        self.enter_motor_menu()
        return position_in(self.console.exchange("a", busy_s=busy_s).lines)

    @staticmethod
    def _tell_unread(refused: CommandRefused) -> NoReturn:
        """Raise the refusal of a question for the position, or what it is else: an answer that is no position."""
        if refused.reason in (Reason.WRONG_MENU, Reason.UNKNOWN_COMMAND) or refused.trouble is not None:
            raise refused
        raise unreadable(str(refused), (str(refused),)) from refused

    def move_motor(self, motor_id: int, degrees: float, *, busy_s: float = 0.0) -> Taken:
        """Send one axis to an absolute angle. Returns when the dish has answered the command.

        `busy_s`: how long a motor may still run, and a dish that waits for it not answer
        (`docs/decisions/0023-a-dish-that-waits-for-its-motors.md`). NoReply (`busy`) when it has not answered 2 s
        later.
        MotionRefused (nothing sent) outside the range of the axis; KeyError for an unknown motor. The cable, no-go
        sectors and limits of yours are for the antenna to see to.
        """
        self._check_range(motor_id, degrees)
        return self._send_move(motor_id, degrees, busy_s)

    def _check_range(self, motor_id: int, degrees: float) -> None:
        axis = self.model.numbered[motor_id]
        if not math.isfinite(degrees):
            raise MotionRefused(
                f"The {axis.name} asked for is {degrees}, which is not an angle. Nothing was sent.",
                reason=Reason.NOT_A_NUMBER,
            )
        if axis.min_deg <= degrees <= axis.max_deg:
            return
        limit = axis.min_deg if degrees < axis.min_deg else axis.max_deg
        by = abs(degrees - limit)
        said = (
            f"{axis.name.capitalize()} {degrees:.2f}° is {by:.2f}° beyond the limit of {limit:.2f}°. Nothing was sent."
        )
        if degrees < limit and axis is self.model.elevation:
            raise BelowFloor(said, limit_deg=limit, by_deg=by)
        raise MotionRefused(said, reason=LIMIT_REASONS[motor_id], limit_deg=limit, by_deg=by)

    def steer_motor(self, motor_id: int, degrees: float) -> Taken:
        """Send one axis to an absolute angle as `move_motor`, as one of a stream of commands that replace each other.

        NoReply (`late`) when the answer is not there as soon as others were: the dish may have taken the command or
        not, and the next one may go out. Where moves queue, the answer is waited for in full.
        """
        return self.move_motor(motor_id, degrees)

    def glance(self) -> Position:
        """Read where the dish is as `read_position`, within such a stream: NoReply (`late`) as `steer_motor`."""
        return self.read_position()

    def heard_position(self) -> Position | None:
        """Return where the dish has said, unasked, that it is; each only once, None where it has not. Sends nothing."""
        return None

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:
        """Send `a <motor> <degrees>` in the motor menu. What it answers is not known: only the position tells."""
        self.enter_motor_menu()
        line = _move_line(motor_id, degrees)
        reply = self.console.exchange(line, busy_s=busy_s, permit=self.permit)
        return Taken(sure=False, said=" / ".join(reply.lines), took_s=self.console.took_s)

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:
        """Return the console lines that may bring the moving axes to rest at these angles: new targets.

        Empty on a firmware that does not take a new target before the move is over.
        """
        return _move_line(MOTOR_AZIMUTH, az_deg), _move_line(MOTOR_ELEVATION, el_deg)

    def abort_lines(self) -> tuple[str, ...]:
        """Return what ends a silent slew at once; empty on a firmware without one."""
        return ()

    def halt_lines(self) -> tuple[str, ...]:
        """Return what brings every axis to rest where it is; empty on a firmware without a command for that."""
        return ()

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:  # noqa: ARG002
        """Send all axes in one go, and return as soon as that is sent.

        Until `slew_is_over` nothing else may be sent, but what ends it, if anything does (`Facts.stop_ladder`).
        CommandRefused (`unsupported`) on a firmware without such a move, or where it needs a skew and None is known.
        """
        raise self._lacks(f"a combined move to {az_deg:.2f}°/{el_deg:.2f}°")

    def slew_is_over(self) -> bool:
        """Return whether the dish has given its prompt back since `begin_slew`. Sends nothing, and does not wait."""
        return True

    def judge(self, line: str, menu: str | None, *, homed: bool | None) -> Verdict:
        """Say what a raw line would do in a menu (None: not known). Sends nothing; any thread."""
        verdict, match = self.hazards.judge(line, menu, homed=homed)
        return aimed(verdict, match)

    def says_restart(self, line: str) -> bool:
        """Return whether a line is of those that it prints only when it starts."""
        return any(mark in line for mark in self.boot_marks)

    def says_target(self, text: str) -> bool:
        """Return whether a line does nothing but say where the dish goes."""
        return TARGET.match(text) is not None

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line at this prompt changes nothing but the menu, in every menu that has such a prompt.

        A learnt prompt names no menu: then those menus count whose command it is.
        """
        learnt = self.dialect.learnt
        menus = [menu for menu, token in self.dialect.prompts.items() if learnt or token == prompt]
        verdicts = [self.hazards.judge(line, menu, homed=True)[0] for menu in menus]
        verdicts = [verdict for verdict in verdicts if verdict.listed or not learnt]
        return bool(verdicts) and all(verdict.grade is Grade.HARMLESS for verdict in verdicts)

    def survey(self) -> Survey:
        """Read what the dish tells about itself; on a firmware that tells nothing, nothing is sent."""
        return Survey()

    def home_motor(self, motor_id: int) -> None:
        """Find the axis' reference. CommandRefused (`unsupported`) on a firmware that homes only by itself."""
        raise self._lacks(f"homing motor {motor_id} by command")

    def may_have_homed(self) -> None:  # noqa: B027 - most keep nothing that homing changes
        """Take note that a line has gone out which finds, or may find, the reference of an axis, whoever typed it."""

    def release_motors(self, *, permit: Callable[[], None] | None = None) -> None:  # noqa: ARG002
        """Take the current off the motors. CommandRefused (`unsupported`) where that can't be done.

        The station's own `permit` is not asked: STOP may do this too. Another one may be given.
        """
        raise self._lacks("releasing its motors")

    def engage_motors(self) -> None:
        """Put the current back on the motors. CommandRefused (`unsupported`) where that can't be done."""
        raise self._lacks("engaging its motors")

    def stow(self) -> None:
        """Fold the dish flat, as the firmware does it. CommandRefused (`unsupported`) where it does not."""
        raise self._lacks("stowing")

    def sweep_axis(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:  # noqa: ARG002
        """Have the firmware sweep an axis from where it stands; `hear` is given each reading, None for an unread line.

        CommandRefused (`unsupported`) on a firmware without a sweep of its own.
        """
        raise self._lacks(f"sweeping its {order.axis} by itself")

    def read_speeds(self) -> dict[int, float]:
        """Read the greatest speed in force of each axis, by motor number, in deg/s; empty if it is not told."""
        return {}

    def set_speed(self, motor_id: int, speed_deg_s: float) -> dict[int, float]:
        """Set the greatest speed of one axis until the dish restarts; return what is in force, read back.

        MotionRefused (`speed`, nothing sent) outside the axis' range, CommandRefused where the dish does not do it,
        KeyError for an unknown motor.
        """
        raise self._lacks(f"setting the speed of motor {motor_id} to {speed_deg_s:g}°/s")

    def get_rssi(self, iterations: int = 10) -> RssiReading:
        """Read the signal strength. CommandRefused (`unsupported`) on a firmware without a tuner."""
        raise self._lacks(f"reading signal strength ({iterations} times)")

    def settings_table(self) -> tuple[str, ...]:
        """Read all settings of the dish, as printed. CommandRefused (`unsupported`) where it has none."""
        raise self._lacks("listing its settings")

    def restore_search(self) -> None:
        """Give the firmware its own TV search back. CommandRefused (`unsupported`) where that can't be done."""
        raise self._lacks("restoring its TV search")

    def _lacks(self, what: str) -> CommandRefused:
        return CommandRefused(f"The {self.model.name} has no command for {what}.", reason=Reason.UNSUPPORTED)

    def interject(self, lines: tuple[str, ...]) -> None:
        """Write lines at once, from any thread, also in the middle of an exchange. For STOP only."""
        self.console.interject(lines)

    @abstractmethod
    def kill_search(self) -> None:
        """End the firmware's automatic TV search, as far as this firmware can: see `Facts.search_switch`."""


def _move_line(motor_id: int, degrees: float) -> str:
    return f"a {motor_id} {angle_text(degrees)}"
