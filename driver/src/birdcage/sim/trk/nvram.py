"""A settings memory as `NVS>` shows it: RAM, flash and factory values (docs/reference/g2-settings.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["hex", "int", "signed", "fixed", "bool"]


@dataclass(frozen=True, slots=True)
class NvramSetting:
    """One setting: how it is called, how it is printed, and what the factory put there."""

    name: str
    kind: Kind
    default: float


class Nvram:
    """RAM and flash. `active` is what the firmware read at power-on and goes by until the next (written for 20)."""

    def __init__(
        self, rows: Mapping[int, NvramSetting], saved: Mapping[int, float], *, takes_hex: str = "either",
        odd_lines: Mapping[int, str] | None = None,
    ) -> None:  # fmt: skip
        """Hold the factory's values, but for those `saved` before.

        `odd_lines` are printed as they are; `takes_hex` as the option `nvs_hex` has it.
        """
        self.rows = rows
        self.odd_lines = odd_lines or {}
        self._takes_hex = takes_hex
        self.flash = {index: row.default for index, row in self.rows.items()} | dict(saved)
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
        self.ram[index] = _value(self.rows[index].kind, text, self._takes_hex)

    def render(self, index: int, value: float) -> str:
        """Print a value the way its row does."""
        return render(self.rows[index].kind, value)


def _value(kind: Kind, text: str, takes_hex: str) -> float:
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
    has_prefix = text.lower().startswith("0x")
    if kind == "hex" and takes_hex == "prefix" and not has_prefix:
        raise ValueError(text)
    if kind == "hex" and takes_hex == "decimal":
        return float(
            text[: len(text) - len(text.lstrip("0123456789"))] or 0
        )  # as C's atoi reads it: up to the first letter
    base = 16 if has_prefix else 10
    whole = int(text, base)
    if not -(2**31) <= whole < 2**32:
        raise ValueError(text)
    return whole


def render(kind: Kind, value: float) -> str:
    """Print a value of a kind."""
    if kind == "bool":
        return "TRUE" if value else "FALSE"
    if kind == "fixed":
        return f"{value:.2f}"
    if kind == "hex":
        return f"0x{int(value) & 0xFFFFFFFF:08X}"
    return f"{int(value):+d}" if kind == "signed" else f"{int(value)}"
