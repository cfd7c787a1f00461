"""Which pins the processor of a G2 has, which way they go, and how they stand at rest.

From the table of docs/reference/g2-commands.md, *GPIO>* (noted, read off a live dish). A pin that it does not name is
an input and low (assumed); one that it names is an input unless it calls it an output (assumed).
"""

from __future__ import annotations

RANGES = {"A": "0-19,24-29", "B": "0-11,16-19", "C": "0-19", "D": "0-15"}
"""26 + 16 + 20 + 16; with the 14 of port E there are 92. A20 to A23 and B12 to B15 are absent. B16 to B19 are
assumed."""
UNKNOWN = "E29"
"""`regs` calls it unknown (noted)."""
TUNER_POWER, LNB_18V = "D10", "C18"
_CALLED_OUTPUTS = {"B0", "B1", "B2", "B3", "B11", "C10", "C11", "C12", "C13", "C18"}
"""Under the heading of outputs that are high, with a dash for the direction."""
OUTPUTS = frozenset({"E0", "E5", "D10", "D11", "E24"} | _CALLED_OUTPUTS)
_SPI1 = {"E0", "E1", "E2", "E4", "E5"}
_SPI2 = {"D10", "D11", "D12", "D13"}
_CONSOLE = {"E24", "E25", "E26", "E27", "E28"}
HIGH = frozenset(_SPI1 | _SPI2 | _CONSOLE | _CALLED_OUTPUTS)


def pins(port_e: str) -> tuple[str, ...]:
    """Return the names of all pins in order; `port_e` as `0-7,12,24-28`.

    Raises:
        ValueError: that is no list of numbers.

    """
    return tuple(f"{port}{number}" for port, text in {**RANGES, "E": port_e}.items() for number in _numbers(text))


def _numbers(text: str) -> list[int]:
    numbers: list[int] = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        numbers += range(int(first), int(last or first) + 1)
    return numbers
