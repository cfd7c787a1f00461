"""The processor's pins, `GPIO>`. The words are quoted (noted), the lines around them are assumed.

Source: docs/reference/g2-commands.md, *GPIO>*.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tuner import HORIZONTAL_V, VERTICAL_V
from birdcage.sim.shell import Script

PINS_A_LINE = 8

# The table of docs/reference/g2-commands.md, *GPIO>* (noted, read off a live dish). A pin that it does not name is an
# input and low (assumed); one that it names is an input unless it calls it an output (assumed).
_RANGES = {"A": "0-19,24-29", "B": "0-11,16-19", "C": "0-19", "D": "0-15"}
"""26 + 16 + 20 + 16; with the 14 of port E there are 92. A20 to A23 and B12 to B15 are absent. B16 to B19 are
assumed."""
_UNKNOWN = "E29"
"""`regs` calls it unknown (noted)."""
_TUNER_POWER, _LNB_18V = "D10", "C18"
_CALLED_OUTPUTS = {"B0", "B1", "B2", "B3", "B11", "C10", "C11", "C12", "C13", "C18"}
"""Under the heading of outputs that are high, with a dash for the direction."""
_OUTPUTS = frozenset({"E0", "E5", "D10", "D11", "E24"} | _CALLED_OUTPUTS)
_SPI1 = {"E0", "E1", "E2", "E4", "E5"}
_SPI2 = {"D10", "D11", "D12", "D13"}
_CONSOLE = {"E24", "E25", "E26", "E27", "E28"}
_HIGH = frozenset(_SPI1 | _SPI2 | _CONSOLE | _CALLED_OUTPUTS)


def _pins_of(port_e: str) -> tuple[str, ...]:
    """Return the names of all pins in order; `port_e` as `0-7,12,24-28`.

    Raises:
        ValueError: that is no list of numbers.

    """
    return tuple(f"{port}{number}" for port, text in {**_RANGES, "E": port_e}.items() for number in _numbers(text))


def _numbers(text: str) -> list[int]:
    numbers: list[int] = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        numbers += range(int(first), int(last or first) + 1)
    return numbers


class GpioMenu(G2Menu):
    """Reads and drives pins. What the motors do to theirs no source tells: they stand as at rest."""

    prompt = "GPIO>"
    help_lines = ("help [<command>]", "dir <pin>", "q", "r <pin>", "regs - all pins", "w <pin> <val>")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"dir": self._direction, "r": self._read, "regs": self._registers, "w": self._write}
        self._pins = _pins_of(board.settings.pins_e)
        self._driven: dict[str, int] = {}
        board.at_power_on.append(self._driven.clear)

    def _direction(self, args: list[str]) -> Script:
        pin = args[0].upper() if len(args) == 1 else None
        if pin is None:
            yield from self.bad_parameter()
        elif pin not in self._pins:
            yield f"Unknown bit {pin}\n"
        else:
            yield "OUTPUT\n" if pin in _OUTPUTS else "INPUT\n"

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
        yield f"Unknown bit {_UNKNOWN}\n"

    def _write(self, args: list[str]) -> Script:
        pin, value = (args[0].upper(), args[1]) if len(args) == 2 else ("", "")
        if value not in ("0", "1"):
            yield from self.bad_parameter()
        elif pin not in self._pins:
            yield f"Unknown bit {pin}\n"
        elif pin in _OUTPUTS:  # an input keeps what the outside puts on it
            self._drive(pin, int(value))

    def _drive(self, pin: str, value: int) -> None:
        tuner, follows = self.board.tuner, self.board.settings.pins_follow
        if follows and pin == _TUNER_POWER:
            tuner.on = bool(value)
        elif follows and pin == _LNB_18V:
            tuner.lnb_volts = HORIZONTAL_V if value else VERTICAL_V
        else:
            self._driven[pin] = value

    def _state(self, pin: str) -> int:
        tuner, follows = self.board.tuner, self.board.settings.pins_follow
        if follows and pin == _TUNER_POWER:
            return int(tuner.on)
        if follows and pin == _LNB_18V:
            return int(tuner.lnb_volts == HORIZONTAL_V)
        return self._driven.get(pin, int(pin in _HIGH))
