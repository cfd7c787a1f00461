"""The processor's pins, `GPIO>`. The words are quoted (noted), the lines around them are assumed.

Source: docs/reference/g2-commands.md, *GPIO>*.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.gpio_pins import HIGH, LNB_18V, OUTPUTS, TUNER_POWER, UNKNOWN, pins
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import HORIZONTAL_V, VERTICAL_V
from birdcage.sim.shell import Script

PINS_A_LINE = 8


class GpioMenu(G2Menu):
    """Reads and drives pins. What the motors do to theirs no source tells: they stand as at rest."""

    prompt = "GPIO>"
    help_lines = ("help [<command>]", "dir <pin>", "q", "r <pin>", "regs - all pins", "w <pin> <val>")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"dir": self._direction, "r": self._read, "regs": self._registers, "w": self._write}
        self._pins = pins(board.settings.pins_e)
        self._driven: dict[str, int] = {}
        board.at_power_on.append(self._driven.clear)

    def _direction(self, args: list[str]) -> Script:
        pin = args[0].upper() if len(args) == 1 else None
        if pin is None:
            yield from self.bad_parameter()
        elif pin not in self._pins:
            yield f"Unknown bit {pin}\n"
        else:
            yield "OUTPUT\n" if pin in OUTPUTS else "INPUT\n"

    def _read(self, args: list[str]) -> Script:
        pin = args[0].upper() if len(args) == 1 else None
        if pin is None:
            yield from self.bad_parameter()
        else:
            yield f"{self._state(pin)}\n" if pin in self._pins else f"Unknown bit {pin}\n"

    def _registers(self, args: list[str]) -> Script:  # noqa: ARG002
        for port in "ABCDE":
            shown = [f"{pin}:{self._state(pin)}" for pin in self._pins if pin[0] == port]
            for first in range(0, len(shown), PINS_A_LINE):
                yield " ".join(shown[first : first + PINS_A_LINE]) + "\n"
        yield f"Unknown bit {UNKNOWN}\n"

    def _write(self, args: list[str]) -> Script:
        pin, value = (args[0].upper(), args[1]) if len(args) == 2 else ("", "")
        if value not in ("0", "1"):
            yield from self.bad_parameter()
        elif pin not in self._pins:
            yield f"Unknown bit {pin}\n"
        elif pin in OUTPUTS:  # an input keeps what the outside puts on it
            self._drive(pin, int(value))

    def _drive(self, pin: str, value: int) -> None:
        tuner, follows = self.board.tuner, self.board.settings.pins_follow
        if follows and pin == TUNER_POWER:
            tuner.on = bool(value)
        elif follows and pin == LNB_18V:
            tuner.lnb_volts = HORIZONTAL_V if value else VERTICAL_V
        else:
            self._driven[pin] = value

    def _state(self, pin: str) -> int:
        tuner, follows = self.board.tuner, self.board.settings.pins_follow
        if follows and pin == TUNER_POWER:
            return int(tuner.on)
        if follows and pin == LNB_18V:
            return int(tuner.lnb_volts == HORIZONTAL_V)
        return self._driven.get(pin, int(pin in HIGH))
