"""The G2's settings memory: RAM, flash and factory values (docs/reference/g2-settings.md, *Rows*).

Only the rows that a source quotes are here; the others are holes, as an index that does not exist.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["hex", "int", "signed", "fixed", "bool"]


@dataclass(frozen=True, slots=True)
class Row:
    """One setting: how it is called, how it is printed, and what the factory put there."""

    name: str
    kind: Kind
    default: float


ROWS: dict[int, Row] = {
    0: Row("Log ID's", "hex", 7),
    1: Row("Log Device", "hex", 1),
    2: Row("Debug 2nd Console Port", "int", 0),
    3: Row("Debug 2nd Packet Port", "int", 0),
    4: Row("Debug Port Connection", "int", 0),
    16: Row("Pitch Deadband", "fixed", 0),
    17: Row("Roll Deadband", "fixed", 0),
    18: Row("Yaw Deadband", "fixed", 0),
    20: Row("Disable Tracker Proc?", "bool", 0),
    21: Row("Tracker Proc Run Mode", "int", 0),
    22: Row("Conical Alpha Az", "int", 200),
    23: Row("Conical Alpha El", "int", 200),
    24: Row("Conical Radius", "fixed", 1),
    25: Row("Conical Count Max", "int", 20),
    26: Row("Conical Test Drift", "signed", 0),
    27: Row("Circle RPM", "int", 120),
    28: Row("Circle Pts/Rev", "int", 6),
    32: Row("Conical Az Clamp", "fixed", 8),
    33: Row("Conical El Clamp", "fixed", 8),
    35: Row("Motor Pts/Rev", "int", 72),
    36: Row("Circle Az Radius", "fixed", 1),
    37: Row("Circle El Radius", "fixed", 1),
    38: Row("Sleep Mode Timer Secs", "int", 420),
    40: Row("Motor Type", "int", 0),
    41: Row("Satellite Scan Velocity", "fixed", 55),
    80: Row("AZ Max Vel", "fixed", 65),
    81: Row("AZ Max Accel", "fixed", 400),
    83: Row("AZ Steps/Rev", "int", 40000),
    85: Row("EL Max Vel", "fixed", 45),
    88: Row("EL Steps/Rev", "int", 24960),
    101: Row("Minimum Elevation Angle", "fixed", 18),
    102: Row("Maximum Elevation Angle", "fixed", 65),
    103: Row("Elevation Home Angle", "fixed", 65),
    112: Row("Disable Dipswitch?", "bool", 0),
    113: Row("Dipswitch Value", "int", 101),
    128: Row("AZ Kp", "fixed", 250),
    129: Row("AZ Kv", "fixed", 50),
    130: Row("AZ Ki", "fixed", 0),
    131: Row("EL Kp", "fixed", 250),
    132: Row("EL Kv", "fixed", 50),
    133: Row("EL Ki", "fixed", 0),
}
"""Only 20, 38, 41, 80, 81, 85, 101 to 103 and 128 to 133 change what this dish does; the others are kept and shown.

That 128 to 133 are the gains is noted; their order, names, kind and values are assumed (settings `pid_kp`,
`pid_kv`, `pid_ki`).
"""
AZ_GAINS, EL_GAINS = 128, 131
"""Their first rows: Kp, Kv and Ki follow each other."""


class Nvram:
    """RAM and flash. `active` is what the firmware read at power-on and goes by until the next (written for 20)."""

    def __init__(self, saved: Mapping[int, float]) -> None:
        """Hold the factory's values, but for those `saved` before."""
        self.flash = {index: row.default for index, row in ROWS.items()} | dict(saved)
        self.ram = dict(self.flash)
        self.active = dict(self.flash)

    def power_on(self) -> None:
        """Read flash; what was not saved is gone."""
        self.ram = dict(self.flash)
        self.active = dict(self.flash)

    def save(self) -> None:
        """Write RAM to flash."""
        self.flash = dict(self.ram)

    def write(self, index: int, text: str) -> None:
        """Set a value in RAM.

        Raises:
            ValueError: the text is no value of this row's kind.

        """
        self.ram[index] = _value(ROWS[index].kind, text)


def _value(kind: Kind, text: str) -> float:
    if kind == "bool":
        words = {"0": 0, "1": 1, "FALSE": 0, "TRUE": 1}
        if text.upper() not in words:
            raise ValueError(text)
        return words[text.upper()]
    if kind == "fixed":
        value = float(text)
        if not math.isfinite(value):
            raise ValueError(text)
        return value
    base = 16 if text.lower().startswith("0x") else 10
    whole = int(text, base)
    if not -(2**31) <= whole < 2**32:
        raise ValueError(text)
    return whole


def render(index: int, value: float) -> str:
    """Print a value the way its row does."""
    kind = ROWS[index].kind
    if kind == "bool":
        return "TRUE" if value else "FALSE"
    if kind == "fixed":
        return f"{value:.2f}"
    if kind == "hex":
        return f"0x{int(value) & 0xFFFFFFFF:08X}"
    return f"{int(value):+d}" if kind == "signed" else f"{int(value)}"
