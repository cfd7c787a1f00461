"""Winegard Carryout G2, firmware 02.02.48 (docs/reference/g2.md)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply, PositionUnknown
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import Reply
from birdcage.protocol.firmware import BOOT_TIMEOUT_S, STALLED
from birdcage.protocol.g2.commands import COMMANDS
from birdcage.protocol.g2.hazards import HAZARDS
from birdcage.protocol.g2.homing import parse_homing
from birdcage.protocol.g2.menus import G2Menus
from birdcage.protocol.g2.model import CARRYOUT_G2, DIALECT, FEATURES
from birdcage.protocol.g2.own_settings import G2OwnSettings
from birdcage.protocol.g2.scan import parse_scan_point
from birdcage.protocol.g2.survey import survey
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.motors import MOTORS
from birdcage.protocol.nvs import DISABLE_TRACKER, NvsRow
from birdcage.protocol.unhomed import is_unhomed, unreadable
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Value
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import OwnSettings
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import Position, RssiReading, Survey, Taken

_DEGREES = r"([-+]?\d+(?:\.\d+)?)(?=\s+[A-Za-z]|\s*$)"
"""A number with a word behind it, or nothing: what noise has cut in two is none."""
_ANGLE = re.compile(rf"Angle\[(\d)\]\s*=\s*{_DEGREES}")
_OTHER_ANGLES = re.compile(r"\bAZ\s*=.*\bEL\s*=")
"""How a Trav'ler prints where it is (docs/reference/travler.md, *Position*); no damage makes it of a G2's answer."""
_PLAUSIBLE = (-720.0, 720.0), (-90.0, 180.0)
"""Azimuth and elevation, wider than any dish turns: what lies outside is a misread number, not an angle."""
_MOVE_TAKEN = re.compile(rf"Angle\s*=\s*{_DEGREES}")
_HOMING_S = 15.0
_SWEEP_QUIET_S = 10.0
"""How long a sweep may print nothing: how long it takes over a position no source says. Only a deadline depends on it.
"""
_MOST_UNREAD = 200
"""So many lines in a row that are no sweep's, and it talks of something else."""
_STOW_S = 60.0
"""How long `stow` may keep the shell: no source says whether it does. Only a deadline depends on it."""


def _is_told(printed: str, degrees: float, *, turns: bool) -> bool:
    """Return whether an angle was commanded, by its print: with its own decimals, and on any turn of the cable."""
    off_deg = shortest_turn(degrees, float(printed)) if turns else float(printed) - degrees
    places = len(printed.partition(".")[2])
    return abs(off_deg) <= max(10.0**-places, 0.01) + 0.001


class CarryoutG2Protocol(G2Menus):
    """The Carryout G2's console: prompts `TRK>`, `MOT>`, `DVB>`, …; homing and TV search switched by NVS 20."""

    name: ClassVar[str] = "g2"
    model: Facts = CARRYOUT_G2
    dialect: ClassVar[ConsoleDialect] = DIALECT
    motor_menu: ClassVar[str] = "mot"
    feature_table: ClassVar[FeatureTable] = FEATURES
    hazards: ClassVar[HazardTable] = HAZARDS
    commands: ClassVar[tuple[CommandDoc, ...]] = COMMANDS
    help_lines: ClassVar[Mapping[str, tuple[str, ...]]] = {"dvb": ("?", "man")}
    boot_marks: ClassVar[tuple[str, ...]] = ("Bootloader", "Motor init", "Ant ID - ", "Boot Complete", "Loc Startup")
    log_marks: ClassVar[tuple[str, ...]] = ("Ant ID - ", "EXTENDED_DVB_DEBUG", "Loc Startup", "Antenna Facing Front")

    def connect(self, port: str, baudrate: int = 115200) -> None:
        """Open the port (8N1) exclusively, at 115200 baud unless told otherwise (docs/reference/g2.md, *Line*)."""
        super().connect(port, baudrate)

    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = BOOT_TIMEOUT_S) -> None:
        """Wait until the console answers (a booting dish does not), then go into the motor menu.

        Copes with a dish that has been up for long: it answers at once. The TV search has no runtime switch on this
        firmware: see `kill_search`. NoReply after `timeout_s`.
        """
        tell = callback or (lambda _line: None)
        started, before = self.clock.monotonic(), ""
        while True:
            try:
                self.console.synchronize()
                break
            except NoReply as silence:
                elapsed = self.clock.monotonic() - started
                if elapsed >= timeout_s or silence.reason == before == Reason.WRONG_FIRMWARE:
                    raise
                before = silence.reason
                tell(f"{elapsed:3.0f} s: no prompt yet ({silence.reason}). The dish may still be booting.")
        try:
            disabled = self.read_nvs(DISABLE_TRACKER).current == "TRUE"
        except CommandRefused:
            self.enter_motor_menu()  # says so if it is another firmware's console
            raise
        tell(
            "The TV search is off (NVS 20 is TRUE)."
            if disabled
            else "NVS 20 is FALSE: this dish homes and searches for TV satellites by itself at power-up."
        )
        self.enter_motor_menu()

    def enter_motor_menu(self) -> None:
        """Enter `mot`. NoReply (`wrong_firmware`) when the dish refuses it twice: every G2 has this menu."""
        try:
            self.console.enter("mot")
        except CommandRefused as once:
            if once.reason != Reason.UNKNOWN_COMMAND:
                raise
            try:
                self.console.enter("mot")  # the line may have been damaged on its way
            except CommandRefused as twice:
                if twice.reason != Reason.UNKNOWN_COMMAND:
                    raise
                raise self._another_firmware() from twice

    def _another_firmware(self) -> NoReply:
        return NoReply(self.dialect.stranger.format(prompt=self.console.prompt), reason=Reason.WRONG_FIRMWARE)

    def glance(self) -> Position:
        """Read both axes with one `a` within a stream of moves; a late answer is never taken for a later one's."""
        try:
            return self._position_in(self.console.hurry("mot", "a", asks=True))
        except CommandRefused as refused:
            self._tell_unread(refused)

    def _read_position(self, busy_s: float) -> Position:
        """Read both axes with one `a` (docs/reference/g2-motors.md, *Position*)."""
        self.enter_motor_menu()
        reply = self.console.run("mot", "a", busy_s=busy_s)
        if not reply.lines:
            # Whatever it knows, `a` prints two lines: this was the answer to an Enter that was still under way.
            self.console.mistrust()
        return self._position_in(reply)

    def _position_in(self, reply: Reply) -> Position:
        printed = {int(m[1]): m[2] for m in _ANGLE.finditer(" ".join(reply.lines))}
        angles = {axis: float(text) for axis, text in printed.items()}
        if set(angles) != {0, 1}:
            if _OTHER_ANGLES.search(" ".join(reply.lines)):
                raise self._another_firmware()
            raise unreadable(f"The dish answered `a` with {' / '.join(reply.lines)!r}, not two angles.", reply.lines)
        if any(map(is_unhomed, angles.values())):
            raise PositionUnknown(
                "The dish is not homed, so it does not know where it points. Home it first.", reason=Reason.UNHOMED
            )
        if not all(low <= angles[axis] <= high for axis, (low, high) in enumerate(_PLAUSIBLE)):
            raise unreadable(f"The dish answered `a` with {' / '.join(reply.lines)!r}: no such angles.", reply.lines)
        self.printed_deg = max(10.0 ** -len(text.partition(".")[2]) for text in printed.values())
        return Position(angles[0], angles[1])

    def _send_move(self, motor_id: int, degrees: float, busy_s: float) -> Taken:
        line = self._move_line(motor_id, degrees)
        reply = self.console.run("mot", line, busy_s=busy_s, permit=self.permit, judged=False)
        return self._take_move(motor_id, degrees, reply)

    def steer_motor(self, motor_id: int, degrees: float) -> Taken:
        """Send one axis to an absolute angle, as one of a stream: each is taken to replace the one before.

        Source: docs/reference/g2-motors.md, *Moving*.
        """
        self._check_range(motor_id, degrees)
        line = self._move_line(motor_id, degrees)
        return self._take_move(motor_id, degrees, self.console.hurry("mot", line, permit=self.permit, judged=False))

    def _take_move(self, motor_id: int, degrees: float, reply: Reply) -> Taken:
        """Read the answer to a move. No refusal is known of a G2: without its angle only the position tells."""
        refusal = self.console.refusal(reply)
        if refusal is not None and STALLED.search(str(refusal)):
            raise refusal
        told = [m[1] for m in map(_MOVE_TAKEN.search, reply.lines) if m]
        if told and not _is_told(told[-1], degrees, turns=motor_id == self.model.azimuth.index):
            # It moves, and where to is not sure.
            raise NoReply(f"The dish answered `{reply.command}` with an angle of {told[-1]}°.", reason=Reason.GARBAGE)
        return Taken(sure=bool(told), said=" / ".join(reply.lines), took_s=self.console.took_s)

    @staticmethod
    def _move_line(motor_id: int, degrees: float) -> str:
        return f"a {motor_id} {degrees:.2f}"

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:
        """Retarget both axes: no stop is documented for this firmware (docs/reference/g2.md, *What it can do*)."""
        lines = (self._move_line(0, az_deg), self._move_line(1, el_deg))
        return tuple(line.replace(" -0.00", " 0.00") for line in lines)

    def home_motor(self, motor_id: int) -> None:
        """Find one axis' reference by stall. Blocks the shell until it is done; can't be stopped.

        Source: docs/reference/g2-motors.md, *Homing*.
        """
        self.model.numbered[motor_id]  # KeyError for a motor that it has not
        self.console.run("mot", f"h {motor_id}", takes_s=_HOMING_S, permit=self.permit)

    def home_motors(self) -> dict[str, Value]:
        """Find the references of both axes (`h *`), as `home_motor`; return what it printed (`parse_homing`).

        Source: docs/reference/g2-motors.md, *Homing*.
        """
        reply = self.console.run("mot", "h *", takes_s=2 * _HOMING_S, permit=self.permit)
        return parse_homing(reply.lines)

    def release_motors(self, *, permit: Callable[[], None] | None = None) -> None:
        """Take the current off the motors (`r`): the dish may fall, and its position is then unknown."""
        self.console.run("mot", "r", permit=permit)

    def engage_motors(self) -> None:
        """Put the current back on the motors (`e`: docs/reference/g2-motors.md, *Moving*)."""
        self.console.run("mot", "e", permit=self.permit)

    def stow(self) -> None:
        """Fold the dish flat (`stow` at the root: docs/reference/consoles.md, *Stow*). Returns with the prompt.

        No source says whether the prompt comes before the motion or after it, nor what stops it.
        """
        self.console.enter(self.dialect.root)
        self.console.run(self.dialect.root, "stow", takes_s=_STOW_S, permit=self.permit)

    def sweep_axis(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:
        """Sweep an axis with `azscanwxp`, from where it stands (docs/reference/g2-motors.md, *Sweeps*).

        The position is read first: unhomed, a sweep hangs the shell until a power cycle (docs/reference/g2.md,
        *Hazards*). `hear` is given each reading as it comes, None for a line of another form. NoReply when nothing
        comes for too long. What the numbers of the transponders are, and whether a key ends it, no source says.
        """
        motor_id, unread = MOTORS[order.axis], 0
        self.get_position()

        def take(line: str) -> None:
            nonlocal unread
            point = parse_scan_point(line)
            if point is not None and point.motor == motor_id and point.angle_deg is not None:
                unread = 0
                hear(SweptReading(order.axis, point.angle_deg, float(point.rssi_counts)))
                return
            unread += 1
            if self.says_restart(line):
                raise NoReply(f"The dish has restarted in the middle of its sweep: {line!r}.", reason=Reason.REBOOT)
            if unread > _MOST_UNREAD:
                raise NoReply(f"The dish printed {unread} lines in a row that are no sweep.", reason=Reason.GARBAGE)
            hear(None)

        line = f"azscanwxp {motor_id} {order.span_deg:.0f} {order.step_deg * 100:.0f} {order.transponders}"
        self.console.relay("mot", line, take, _SWEEP_QUIET_S, self.permit)

    def abort_lines(self) -> tuple[str, ...]:
        """Return a bare Enter: it may end a sweep, and harms nothing where it does not."""
        return ("",)

    def read_speeds(self) -> dict[int, float]:
        """Read `step`, `mv` (docs/reference/g2-commands.md, *STEP>*)."""
        return self.stepper.max_speeds_deg_s()

    def set_speed(self, motor_id: int, speed_deg_s: float) -> dict[int, float]:
        """Send `step`, `mv [motor] [ustep/sec]` (docs/reference/g2-commands.md, *STEP>*), and read it back."""
        return self.stepper.set_max_speed(motor_id, speed_deg_s)

    def enter_dvb_menu(self) -> None:
        """Enter `dvb`."""
        self.console.enter("dvb")

    def enable_lna(self) -> None:
        """Feed the LNB with 13 V (`lnbdc odu`: docs/reference/g2-signal.md, *Signal strength*)."""
        self.tuner.supply_13_volts()

    def get_rssi(self, iterations: int = 10) -> RssiReading:
        """Read the tuner's signal strength, averaged over `iterations` reads. In counts, no unit.

        Source: docs/reference/g2-signal.md, *Signal strength*.
        """
        return self.tuner.rssi(iterations)

    def quit_submenu(self) -> None:
        """Leave the present submenu; nothing is sent at the root."""
        self.console.leave()

    def survey(self) -> Survey:
        """Read identity, limits, TV search and speeds."""
        return survey(self.system, self.nvs, self.stepper)

    def read_nvs(self, index: int) -> NvsRow:
        """Read one row of the settings memory. NoReply (no_row) when there is no such row.

        Source: docs/reference/g2-settings.md.
        """
        return self.nvs.read(index)

    def write_nvs(self, index: int, value: str) -> NvsRow:
        """Write one row in RAM, save it to flash, and read it back. Takes effect after a power cycle."""
        return self.nvs.write_and_save(index, value)

    @property
    def own_settings(self) -> OwnSettings:
        """The settings memory, as that of any machine."""
        return G2OwnSettings(lambda: self.nvs)

    def settings_table(self) -> tuple[str, ...]:
        """Read the whole settings memory with `nvs`, `d`, as printed."""
        return self.nvs.printed()

    def kill_search(self) -> None:
        """Switch the TV search off for good: NVS 20 TRUE, saved (docs/reference/g2-settings.md, *The TV search*).

        Takes effect after a power cycle. From then on the dish does not home by itself.
        """
        self.save_search(disabled=True)

    def restore_search(self) -> None:
        """Walk `kill_search` back: NVS 20 FALSE, saved. Takes effect after a power cycle."""
        self.save_search(disabled=False)

    def save_search(self, *, disabled: bool) -> NvsRow:
        """Save NVS 20 where it is not so yet; return the row as it was read last."""
        row = self.read_nvs(DISABLE_TRACKER)
        if row.saved != ("TRUE" if disabled else "FALSE"):
            row = self.write_nvs(DISABLE_TRACKER, "1" if disabled else "0")
        return row
