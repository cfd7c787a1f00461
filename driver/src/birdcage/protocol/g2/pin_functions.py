"""What the pins of a G2's processor are for, and how a port of them is told (docs/reference/g2-commands.md, *GPIO>*).

Functions are those that the page has. `likely` stands where it says so: somebody has concluded it, and not seen it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

PORTS = "ABCDE"
FUNCTIONS: Mapping[str, tuple[str, str]] = {
    "B0": ("", "likely SPI0 or I2C bus"),
    "B1": ("", "likely SPI0 or I2C bus"),
    "B2": ("", "likely SPI0 or I2C bus"),
    "B3": ("", "likely SPI0 or I2C bus"),
    "B11": ("", "likely status LED or enable of a peripheral"),
    "C10": ("", "likely a bus interface"),
    "C11": ("", "likely a bus interface"),
    "C12": ("", "likely a bus interface"),
    "C13": ("", "likely a bus interface"),
    "C18": ("", "likely LNB voltage control or relay"),
    "D10": ("", "likely BCM4515 reset or power enable"),
    "D11": ("SPI2_PCS0", "BCM4515 chip select (tuner)"),
    "D12": ("SPI2_SCK", "SPI clock of the tuner"),
    "D13": ("SPI2_SOUT", "MOSI, processor to BCM4515"),
    "D14": ("SPI2_SIN", "MISO, BCM4515 to processor"),
    "D15": ("SPI2_PCS1", "second chip select, likely unused"),
    "E0": ("SPI1_PCS1", "A3981 #2 chip select (EL motor)"),
    "E1": ("SPI1_SOUT", "MOSI, processor to A3981"),
    "E2": ("SPI1_SCK", "SPI clock of the motor drivers"),
    "E3": ("SPI1_SIN", "MISO, A3981 to processor"),
    "E4": ("SPI1_PCS0", "A3981 #1 chip select (AZ motor)"),
    "E5": ("SPI1_PCS2", "likely A3981 reset or enable"),
    "E24": ("UART4_TX", "console TX, to the computer"),
    "E25": ("UART4_RX", "console RX, from the computer"),
    "E26": ("UART4_CTS", "flow control of the console, idle high"),
    "E27": ("GPIO", "likely RTS of the console or a pull-up"),
    "E28": ("GPIO", "unknown"),
}
"""The signal on a pin, empty where it is not known, and what it is for."""
_HEADS = {1: "high", 0: "low", None: "unknown"}
"""Pins without a function, by state: None for one that the dish calls unknown."""


def lines_of_port(port: str, states: Mapping[str, int | None]) -> tuple[str, ...]:
    """Return what the pins of a port tell: one with a function on a line of its own, all others by their state.

    Nothing where `states` has no pin of that port.
    """
    pins = sorted((pin for pin in states if pin[0] == port), key=_number)
    named = [pin for pin in pins if pin in FUNCTIONS and states[pin] is not None]
    lines = [f"{pin:<4}{states[pin]}  {FUNCTIONS[pin][0]:<10}{FUNCTIONS[pin][1]}".rstrip() for pin in named]
    for state, head in _HEADS.items():
        others = [pin for pin in pins if pin not in named and states[pin] == state]
        if others:
            lines.append(f"{head}: {_compact(port, map(_number, others))}")
    return tuple(lines)


def _number(pin: str) -> int:
    return int(pin[1:])


def _compact(port: str, numbers: Iterable[int]) -> str:
    """Return pins as `A0 to A19, A24`."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{port}{run[0]}" if len(run) == 1 else f"{port}{run[0]} to {port}{run[-1]}" for run in runs)
