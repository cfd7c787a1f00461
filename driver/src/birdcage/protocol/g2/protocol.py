"""Winegard Carryout G2, firmware 02.02.48 (docs/reference/g2.md)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.firmware import BOOT_TIMEOUT_S
from birdcage.protocol.g2.commands import COMMANDS
from birdcage.protocol.g2.hazards import HAZARDS
from birdcage.protocol.g2.menus import G2Menus
from birdcage.protocol.g2.model import CARRYOUT_G2, DIALECT, FEATURES
from birdcage.protocol.g2.own_settings import KNOWN
from birdcage.protocol.g2.scan import parse_scan_point
from birdcage.protocol.g2.survey import survey
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.motors import MOTORS
from birdcage.protocol.nvs import DISABLE_TRACKER
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import SettingKnown
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import RssiReading, Survey

_SWEEP_QUIET_S = 10.0
"""How long a sweep may print nothing: how long it takes over a position no source says. Only a deadline depends on it.
"""
_MOST_UNREAD = 200
"""So many lines in a row that are no sweep's, and it talks of something else."""
_STOW_S = 60.0
"""How long `stow` may keep the shell: no source says whether it does. Only a deadline depends on it."""


class CarryoutG2Protocol(G2Menus):
    """The Carryout G2's console: prompts `TRK>`, `MOT>`, `DVB>`, …; homing and TV search switched by NVS 20."""

    name: ClassVar[str] = "g2"
    model: Facts = CARRYOUT_G2
    dialect: ClassVar[ConsoleDialect] = DIALECT
    motor_menu: ClassVar[str] = "mot"
    feature_table: ClassVar[FeatureTable] = FEATURES
    hazards: ClassVar[HazardTable] = HAZARDS
    commands: ClassVar[tuple[CommandDoc, ...]] = COMMANDS
    settings_known: ClassVar[Mapping[int, SettingKnown]] = KNOWN
    help_lines: ClassVar[Mapping[str, tuple[str, ...]]] = {"dvb": ("?", "man")}
    boot_marks: ClassVar[tuple[str, ...]] = ("Bootloader", "Motor init", "Ant ID - ", "Boot Complete", "Loc Startup")
    log_marks: ClassVar[tuple[str, ...]] = ("Ant ID - ", "EXTENDED_DVB_DEBUG", "Loc Startup", "Antenna Facing Front")

    def initialize(self, callback: Callable[[str], None] | None = None, *, timeout_s: float = BOOT_TIMEOUT_S) -> None:
        """Wait until the console answers (a booting dish does not), then go into the motor menu.

        Copes with a dish that has been up for long: it answers at once. The TV search has no runtime switch on this
        firmware: see `kill_search`. NoReply after `timeout_s`.
        """
        tell = callback or (lambda _line: None)
        self._await_prompt(tell, timeout_s)
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
