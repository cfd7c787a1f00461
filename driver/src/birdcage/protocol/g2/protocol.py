"""Winegard Carryout G2, firmware 02.02.48 (reference section 7)."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import ClassVar

from birdcage.base.errors import CommandRefused, MotionRefused, NoReply, PositionUnknown
from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.command_list import CommandDoc
from birdcage.protocol.g2.commands import COMMANDS
from birdcage.protocol.g2.hazards import HAZARDS
from birdcage.protocol.g2.model import CARRYOUT_G2, DIALECT
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.model import DishModel
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, NvsRow, parse_nvs
from birdcage.protocol.protocol import BOOT_TIMEOUT_S, FirmwareProtocol
from birdcage.protocol.types import Position, RssiReading, Survey

UNHOMED = 2147483647.0
"""INT_MAX: what an axis reports until it is homed (section 7.2)."""

_ANGLE = re.compile(r"Angle\[(\d)\]\s*=\s*([-+]?\d+(?:\.\d+)?)")
_MOVE_TAKEN = re.compile(r"Angle\s*=\s*([-+]?\d+(?:\.\d+)?)")
_MAX_VEL = re.compile(r"Max Vel\s*\[(\d)\]\s*=\s*(\d+)(?![\d.])")
_RSSI = re.compile(r"Reads:(\d+)\s+RSSI\[avg:\s*(\d+)\s+cur:\s*(\d+)\]")
_ID_FIELD = re.compile(r"^\s*([A-Za-z][\w -]*?):\s+(.+?)\s*$")
_HOMING_S = 15.0
_STOW_S = 60.0
"""How long `stow` may keep the shell: no source says whether it does. Only a deadline depends on it."""
_RSSI_READ_S = 0.1
"""A generous guess of what one read of `rssi n` takes; only a deadline depends on it."""


class CarryoutG2Protocol(FirmwareProtocol):
    """The Carryout G2's console: prompts `TRK>`, `MOT>`, `DVB>`, …; homing and TV search switched by NVS 20."""

    name: ClassVar[str] = "g2"
    model: ClassVar[DishModel] = CARRYOUT_G2
    dialect: ClassVar[ConsoleDialect] = DIALECT
    motor_menu: ClassVar[str] = "mot"
    hazards: ClassVar[HazardTable] = HAZARDS
    commands: ClassVar[tuple[CommandDoc, ...]] = COMMANDS
    help_lines: ClassVar[Mapping[str, tuple[str, ...]]] = {"dvb": ("?", "man")}
    boot_marks: ClassVar[tuple[str, ...]] = ("Bootloader", "Motor init", "Ant ID - ", "Boot Complete", "Loc Startup")

    def connect(self, port: str, baudrate: int = 115200) -> None:
        """Open the port (8N1) exclusively, at 115200 baud unless told otherwise (section 7.2)."""
        super().connect(port, baudrate)

    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = BOOT_TIMEOUT_S) -> None:
        """Wait until the console answers (a booting dish does not), then go into the motor menu.

        Copes with a dish that has been up for long: it answers at once. The TV search has no runtime switch on this
        firmware: see `kill_search`. NoReply after `timeout_s`.
        """
        tell = callback or (lambda _line: None)
        started = self.clock.monotonic()
        while True:
            try:
                self.console.synchronize()
                break
            except NoReply as silence:
                elapsed = self.clock.monotonic() - started
                if elapsed >= timeout_s:
                    raise
                tell(f"{elapsed:3.0f} s: no prompt yet ({silence.reason}). The dish may still be booting.")
        disabled = self.read_nvs(DISABLE_TRACKER).current == "TRUE"
        tell(
            "The TV search is off (NVS 20 is TRUE)."
            if disabled
            else "NVS 20 is FALSE: this dish homes and searches for TV satellites by itself at power-up."
        )
        self.enter_motor_menu()

    def enter_motor_menu(self) -> None:
        """Enter `mot`."""
        self.console.enter("mot")

    def get_position(self) -> Position:
        """Read both axes with one `a` (section 7.4). PositionUnknown: not homed, or released since."""
        reply = self.console.run("mot", "a")
        angles = {int(m[1]): float(m[2]) for m in map(_ANGLE.search, reply.lines) if m}
        if set(angles) != {0, 1}:
            self.gate.forget("unread")
            raise NoReply(f"The dish answered `a` with {' / '.join(reply.lines)!r}, not two angles.", reason="garbage")
        if UNHOMED in angles.values():
            self.gate.forget("unhomed")
            raise PositionUnknown(
                "The dish is not homed, so it does not know where it is. Home it first.", reason="unhomed"
            )
        position = Position(angles[0], angles[1])
        self.gate.see(position)
        return position

    def _send_move(self, motor_id: int, degrees: float) -> None:
        line = self._move_line(motor_id, degrees)
        reply = self.console.run("mot", line, permit=self.permit)
        taken = [float(m[1]) for m in map(_MOVE_TAKEN.search, reply.lines) if m]
        if taken and abs(taken[-1] - degrees) > 0.011:
            # It moves, and where to is not sure: no refusal.
            raise NoReply(f"The dish answered `{line}` with an angle of {taken[-1]:.2f}°.", reason="garbage")
        if not taken:
            raise CommandRefused(
                f"The dish did not take `{line}`; it answered {' / '.join(reply.lines)!r}.",
                reason="bad_parameter",
            )

    @staticmethod
    def _move_line(motor_id: int, degrees: float) -> str:
        return f"a {motor_id} {degrees:.2f}"

    def stop_lines(self, az_deg: float, el_deg: float) -> tuple[str, ...]:
        """Retarget both axes: no stop is documented for this firmware (reference section 11)."""
        lines = (self._move_line(0, az_deg), self._move_line(1, el_deg))
        return tuple(line.replace(" -0.00", " 0.00") for line in lines)

    def home_motor(self, motor_id: int) -> None:
        """Find one axis' reference by stall. Blocks the shell until it is done (section 7.4); can't be stopped."""
        self.model.axis(motor_id)
        self.gate.forget("unread")
        self.console.run("mot", f"h {motor_id}", takes_s=_HOMING_S, permit=self.permit)
        self.gate.found_reference(motor_id)

    def release_motors(self, *, permit: Callable[[], None] | None = None) -> None:
        """Take the current off the motors (`r`): the dish may fall, and its position is then unknown."""

        def goes_out() -> None:
            if permit is not None:
                permit()
            self.gate.release()

        self.console.run("mot", "r", permit=goes_out)

    def engage_motors(self) -> None:
        """Put the current back on the motors (`e`, section 7.3)."""
        self.console.run("mot", "e", permit=self.permit)

    def stow(self) -> None:
        """Fold the dish flat (`stow` at the root: sections 2.9 and 7.3). Returns with the prompt.

        No source says whether the prompt comes before the motion or after it, nor what stops it.
        """
        self.console.enter(self.dialect.root)
        self.gate.forget("unread")
        self.console.run(self.dialect.root, "stow", takes_s=_STOW_S, permit=self.permit)

    def read_speeds(self) -> dict[int, float]:
        """Read `step`, `mv`: microsteps/s (section 7.3; 7222 of 40000 a turn are 65 deg/s)."""
        found = [m for line in self.console.run("step", "mv").lines for m in _MAX_VEL.finditer(line)]
        axes = {axis.index: axis for axis in (self.model.azimuth, self.model.elevation)}
        return {int(m[1]): int(m[2]) * axes[int(m[1])].step_deg for m in found if int(m[1]) in axes and int(m[2]) > 0}

    def set_speed(self, motor_id: int, speed_deg_s: float) -> dict[int, float]:
        """Send `step`, `mv [motor] [ustep/sec]` (section 7.3), and read it back."""
        axis = self.model.axis(motor_id)
        if not axis.step_deg <= speed_deg_s <= axis.speed_deg_s:
            raise MotionRefused(
                f"The {axis.name} can go at up to {axis.speed_deg_s:g}°/s and more than 0, not at {speed_deg_s:g}°/s. "
                "Nothing was sent.",
                reason="speed",
            )
        steps = math.floor(speed_deg_s / axis.step_deg + 1e-6)
        self.console.run("step", f"mv {motor_id} {steps}")
        speeds = self.read_speeds()
        now = speeds.get(motor_id)
        if now is None or abs(now - steps * axis.step_deg) > 1.5 * axis.step_deg:
            shown = "none" if now is None else f"{now:.2f}°/s"
            raise CommandRefused(
                f"The dish was told {speed_deg_s:.2f}°/s for the {axis.name} and shows {shown}.", reason="bad_parameter"
            )
        return speeds

    def enter_dvb_menu(self) -> None:
        """Enter `dvb`."""
        self.console.enter("dvb")

    def enable_lna(self) -> None:
        """Feed the LNB with 13 V (`lnbdc odu`, section 7.6)."""
        self.console.run("dvb", "lnbdc odu")

    def get_rssi(self, iterations: int = 10) -> RssiReading:
        """Read the tuner's signal strength, averaged over `iterations` reads (section 7.6). In counts, no unit."""
        if not 1 <= iterations <= 1000:
            raise ValueError(f"iterations must lie in 1..1000, not {iterations}")
        reply = self.console.run("dvb", f"rssi {iterations}", takes_s=iterations * _RSSI_READ_S)
        for match in map(_RSSI.search, reply.lines):
            if match:
                return RssiReading(*(int(number) for number in match.groups()))
        raise NoReply(f"The dish answered `rssi` with {' / '.join(reply.lines)!r}.", reason="garbage")

    def quit_submenu(self) -> None:
        """Leave the present submenu; nothing is sent at the root."""
        self.console.leave()

    def survey(self) -> Survey:
        """Read identity (`os`, `id`: section 7.1), limits and TV search (NVS 101, 102, 20), and speeds (`step`)."""
        rows = {}
        for index in (DISABLE_TRACKER, MIN_ELEVATION, MAX_ELEVATION):
            try:
                rows[index] = self.read_nvs(index)
            except NoReply as missing:
                if missing.reason != "no_row":
                    raise
        try:
            speeds = self.read_speeds()
        except CommandRefused:
            speeds = {}  # a G2 with another stepper menu: the model's speeds hold
        reply = self.console.run("os", "id")
        identity = {m[1]: m[2] for m in map(_ID_FIELD.match, reply.lines) if m}
        limits = [_degrees(rows.get(i)) for i in (MIN_ELEVATION, MAX_ELEVATION)]
        return Survey(
            identity=identity,
            version=identity.get("Software"),
            settings={f"nvs.{index}": row.current for index, row in rows.items()},
            el_min_deg=limits[0],
            el_max_deg=limits[1],
            speeds=speeds,
            search_disabled=rows[DISABLE_TRACKER].current == "TRUE" if DISABLE_TRACKER in rows else None,
        )

    def read_nvs(self, index: int) -> NvsRow:
        """Read one row of the settings memory (section 7.5). NoReply (no_row) when there is no such row."""
        rows = parse_nvs(self.console.run("nvs", f"d {index}").lines)
        if index not in rows:
            raise NoReply(f"The dish showed no NVS row {index}.", reason="no_row")
        return rows[index]

    def write_nvs(self, index: int, value: str) -> NvsRow:
        """Write one row in RAM, save it to flash, and read it back. Takes effect after a power cycle."""
        self.console.run("nvs", f"e {index} {value}")
        saved = self.console.run("nvs", "s", takes_s=10.0)
        if not any("Success" in line for line in saved.lines):
            raise CommandRefused(f"The dish did not save: {' / '.join(saved.lines)!r}.", reason="bad_parameter")
        return self.read_nvs(index)

    def settings_table(self) -> tuple[str, ...]:
        """Read the whole settings memory with `nvs`, `d`, as printed."""
        return self.console.run("nvs", "d", takes_s=10.0).lines

    def kill_search(self) -> None:
        """Switch the TV search off for good: NVS 20 TRUE, saved (section 7.5).

        Takes effect after a power cycle. From then on the dish does not home by itself.
        """
        if self.read_nvs(DISABLE_TRACKER).saved != "TRUE":
            self.write_nvs(DISABLE_TRACKER, "1")

    def restore_search(self) -> None:
        """Walk `kill_search` back: NVS 20 FALSE, saved. Takes effect after a power cycle."""
        if self.read_nvs(DISABLE_TRACKER).saved != "FALSE":
            self.write_nvs(DISABLE_TRACKER, "0")


def _degrees(row: NvsRow | None) -> float | None:
    """Return the angle in force of a setting; None when there is no such row. NoReply when it is not a number."""
    if row is None:
        return None
    try:
        value = float(row.current)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise NoReply(f"The dish showed {row.current!r} in NVS row {row.index}, which is no angle.", reason="garbage")
    return value
