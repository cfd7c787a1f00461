"""The firmware of a Carryout G2, put together."""

from __future__ import annotations

from functools import partial

from birdcage.sim.axis import STALL_DWELL_S, AxisMechanics
from birdcage.sim.firmware import FirmwareHost, FirmwareKind
from birdcage.sim.g2.a3981 import A3981Menu
from birdcage.sim.g2.adc import AdcMenu
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.boot import BEFORE_HOMING, boot_log
from birdcage.sim.g2.dipswitch import DipswitchMenu
from birdcage.sim.g2.dvb import DvbMenu
from birdcage.sim.g2.eeprom import EepromMenu
from birdcage.sim.g2.gpio import GpioMenu
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.g2.latlon import LatLonMenu
from birdcage.sim.g2.mechanics import G2Dish
from birdcage.sim.g2.mot import MotMenu
from birdcage.sim.g2.nvs import G2NvsMenu
from birdcage.sim.g2.peak import PeakMenu
from birdcage.sim.g2.root import G2RootMenu
from birdcage.sim.g2.step import StepMenu
from birdcage.sim.g2.system import SystemMenu
from birdcage.sim.g2.tracker import Tracker
from birdcage.sim.shell import Menu, Pause, Script


class G2Firmware:
    """Version 02.02.48 (docs/reference/g2.md)."""

    baud = 115200
    """Source: docs/reference/g2.md, *Line*."""

    def __init__(self, settings: G2Settings, host: FirmwareHost) -> None:
        self.dish = G2Dish(settings, host.truth)
        self.board = G2Board(settings, host.machine, self.dish, host.restart)
        self.tracker = Tracker(self.board)
        self.menus = menus(self.board)
        self._host = host
        for axis in self.dish.axes:
            axis.slips_at_stop = settings.stall == "slip"
            axis.on_strike = partial(self._strikes, axis)
            axis.on_blocked = partial(self._pushes, axis)

    def resume(self) -> None:
        """Stand still: one whose search is on has found its satellite."""
        self._host.shell.hears = self.board.sleep.hears

    def halt(self) -> None:
        """Give up the TV search."""
        self.tracker.stop()

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory, and return the boot log."""
        self._host.shell.hears = self.board.sleep.hears
        self.board.power_on()
        return boot_log(self.board, self.tracker) if home else _restart_log()

    def stalled(self, axis: AxisMechanics) -> None:
        """Say so (noted of another dish of this maker: docs/reference/consoles.md, *Stalls*)."""
        self._host.say(f"{axis.data.name} MOTOR STALLED\n")

    def _strikes(self, axis: AxisMechanics, end_s: float) -> None:
        """Foresee that a motion will end at a stop: the firmware says so then, unless it ended otherwise."""

        def struck() -> None:
            if axis.end_s() == end_s:
                self.stalled(axis)

        self._host.machine.at_dish(end_s, struck)

    def _pushes(self, axis: AxisMechanics) -> None:
        """Find out that an axis does not turn, as at a stop; not when it was freed meanwhile."""
        machine = self._host.machine
        machine.at_dish(machine.dish_s + STALL_DWELL_S, lambda: self.stalled(axis) if axis.stalled else None)


def _restart_log() -> Script:
    for seconds, line in BEFORE_HOMING:
        yield Pause(seconds)
        yield f"{line}\n"
    yield "Boot Complete\n"


def menus(board: G2Board) -> dict[str, Menu]:
    """Return every menu by the word that enters it."""
    return {
        "root": G2RootMenu(board),
        "a3981": A3981Menu(board),
        "adc": AdcMenu(board),
        "dipswitch": DipswitchMenu(board),
        "dvb": DvbMenu(board),
        "eeprom": EepromMenu(board),
        "gpio": GpioMenu(board),
        "latlon": LatLonMenu(board),
        "mot": MotMenu(board),
        "nvs": G2NvsMenu(board),
        "os": SystemMenu(board),
        "peak": PeakMenu(board),
        "step": StepMenu(board),
    }


KIND = FirmwareKind(G2Settings, G2Firmware)
