"""The Trav'ler Pro, put together: an indoor unit, and behind its tunnel the menus of an older Trav'ler.

`docs/reference/travler-pro.md`.
"""

from __future__ import annotations

import math

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.firmware import Firmware, FirmwareHost, FirmwareKind, Send
from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.boot import restart_log
from birdcage.sim.hal.firmware import Hal000Firmware
from birdcage.sim.hal.knobs import HalSettings, ProSettings
from birdcage.sim.hal.mechanics import HalDish
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.hal.root import HalRootMenu
from birdcage.sim.machine import Machine
from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import ConsoleShell, Enter, Script, quitting

HIGHEST_DEG = 75.0
"""Past this the elevation stalls (`docs/reference/travler-pro.md`, *Elevation*)."""


class IduMenu(HalMenu):
    """The indoor unit: of its commands `odu` alone is written. What `q` does here is the setting `root_q`."""

    help_lines = ("odu", "q")

    def __init__(self, board: HalBoard) -> None:
        super().__init__(board, board.settings.prompt_root)
        self.commands |= {"odu": self._tunnel, "q": self._quit}

    def _tunnel(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Enter("odu")

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self.board.settings.root_q, self.unknown)


class OduMenu(HalRootMenu):
    """The outdoor unit: all that moves. What `q` does here is the setting `odu_q`; no command is known to leave it."""

    def __init__(self, board: HalBoard, submenus: tuple[str, ...], settings: ProSettings) -> None:
        super().__init__(board, submenus)
        self.prompt = settings.prompt_alike if settings.prompts == "alike" else settings.prompt_odu
        self._q = settings.odu_q

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self._q, self.unknown)


class ProBoard(HalBoard):
    """The board of the outdoor unit, which may not survive its own elevation."""

    def __init__(self, settings: ProSettings, host: FirmwareHost, dish: HalDish) -> None:
        self._locks_up = settings.too_high == "lock_up"
        super().__init__(settings, host, dish)

    def stalled(self, axis: AxisMechanics) -> None:
        """Tell of it, and fall silent where it was the elevation past 75 degrees (setting `too_high`)."""
        super().stalled(axis)
        if self._locks_up and axis is self.dish.axes[1] and axis.count(self.now_s)[0] > HIGHEST_DEG:
            self.brake()
            self.host.shell.reset(alive=False)


class ProFirmware(Hal000Firmware):
    """The two units as one console: the tunnel is a menu that is entered and not left."""

    baud = 0
    """Over USB it has none of its own (`docs/reference/travler-pro.md`, *Line*)."""

    def __init__(self, settings: ProSettings, host: FirmwareHost) -> None:
        self._pro = settings
        super().__init__(settings, host)
        submenus = self._submenus()
        for menu in submenus.values():
            menu.above = "odu"
        self.menus = {
            "root": IduMenu(self.board), "odu": OduMenu(self.board, tuple(submenus), settings), **submenus
        }  # fmt: skip

    def _board(self, settings: HalSettings, host: FirmwareHost) -> HalBoard:  # noqa: ARG002
        return ProBoard(self._pro, host, self.dish)

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory, and return the boot log; without the setting `homes` nothing moves by itself."""
        if not home or self._pro.homes:
            return super().boot(home=home)
        self.board.memory.power_on()
        for axis in self.dish.axes:
            axis.homed = True
        return restart_log(self.board)


class HurriedLines:
    """Loses a line that begins too soon after the end of the one before it.

    How soon that is depends on where the one before it went: settings `gap_s`, `odu_gap_s`, `motor_gap_s`.
    """

    def __init__(self, machine: Machine, settings: ProSettings, shell: ConsoleShell) -> None:
        self._machine, self._settings, self._shell = machine, settings, shell
        self._deaf_until_s = -math.inf
        self._inside = self._losing = False

    def hear(self, data: bytes) -> bytes:
        """Return what the shell gets of what comes off the wire."""
        now, kept = self._machine.now, bytearray()
        for byte in data:
            if not self._inside:
                self._losing = now < self._deaf_until_s
            self._inside = byte not in b"\r\n"
            if not self._losing:
                kept.append(byte)
                self._deaf_until_s = self._deaf_until_s if self._inside else now + self._gap_s()
        return bytes(kept)

    def _gap_s(self) -> float:
        match self._shell.menu:
            case "root":
                return self._settings.gap_s
            case "mot":
                return self._settings.motor_gap_s
            case _:
                return self._settings.odu_gap_s


def pro_shell(machine: Machine, settings: SimSettings, firmware: Firmware, send: Send, echo: Send) -> ConsoleShell:
    """Return a shell that loses lines which come too fast."""
    assert isinstance(settings, ProSettings), "it is of this firmware"
    shell = ConsoleShell(machine, settings, firmware.menus, send, echo)
    shell.hears = HurriedLines(machine, settings, shell).hear
    return shell


KIND = FirmwareKind(ProSettings, ProFirmware, pro_shell)
