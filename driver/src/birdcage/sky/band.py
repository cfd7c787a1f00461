"""What a converter makes of a frequency: the intermediate frequency, which way round, and who can tune to it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from typing import Any

_UNITS = {"": 1e6, "hz": 1.0, "k": 1e3, "m": 1e6, "g": 1e9}
"""A number without a unit is in megahertz: here, in every option and in the setup."""
_FREQUENCY = re.compile(r"\s*(\d+(?:[.,]\d*)?(?:e\+?\d+)?|[.,]\d+)\s*(hz|(?:([kmg])(?:hz)?)?)\s*", re.IGNORECASE)
MOST_HZ = 1e12


def parse_frequency(text: str) -> float:
    """Return a frequency in Hz: `9750M`, `9750`, `10.4895 GHz`, `1701300000Hz`. ValueError, a sentence, for none."""
    found = _FREQUENCY.fullmatch(text)
    if found is None:
        raise ValueError(f"{text.strip()!r} is not a frequency. Type 137.1M or 10.4895G; a bare number is in MHz.")
    unit = (found[3] or found[2]).lower()
    hz = float(found[1].replace(",", ".")) * _UNITS[unit]
    if not 1.0 <= hz <= MOST_HZ:
        bare = "" if unit else f" A bare number is in MHz: for hertz type {text.strip()}Hz."
        raise ValueError(f"{text.strip()!r} is not between 1 Hz and 1 THz.{bare}")
    return hz


def megahertz(hz: float) -> str:
    """Return a frequency as people read it, to the hertz: `10489.5 MHz`."""
    return f"{hz / 1e6:.6f}".rstrip("0").rstrip(".") + " MHz"


@dataclass(frozen=True, slots=True)
class FrequencyRange:
    """A row of `data/bands.toml`: something with a name and a range of frequencies."""

    name: str
    low_hz: float
    high_hz: float
    source: str
    lo_hz: float | None = None
    """Its local oscillator, of a converter."""
    note: str = ""

    def holds(self, hz: float) -> bool:
        """Return whether a frequency lies in it."""
        return self.low_hz <= hz <= self.high_hz

    def beside_hz(self, hz: float) -> float:
        """Return by how much a frequency lies below (negative) or above it; 0 within."""
        return min(hz - self.low_hz, 0.0) + max(hz - self.high_hz, 0.0)


@dataclass(frozen=True, slots=True)
class Conversion:
    """What a converter with one oscillator makes of one frequency."""

    rf_hz: float
    lo_hz: float
    """0: there is no converter."""

    @property
    def if_hz(self) -> float:
        """The intermediate frequency, never negative."""
        return abs(self.rf_hz - self.lo_hz)

    @property
    def inverted(self) -> bool:
        """Whether the spectrum comes out mirrored: the oscillator is above the signal."""
        return self.lo_hz > self.rf_hz

    @property
    def image_hz(self) -> float | None:
        """What else lands on the same frequency, if no filter holds it back; None without a converter, or below 0."""
        image = 2.0 * self.lo_hz - self.rf_hz
        return image if self.lo_hz and image > 0.0 else None


def rf_of(lo_hz: float, if_hz: float) -> tuple[Conversion, ...]:
    """Return what may have been converted to an intermediate frequency: above the oscillator first, then below it."""
    sums = (lo_hz + if_hz, lo_hz - if_hz) if lo_hz else (if_hz,)
    return tuple(Conversion(rf_hz, lo_hz) for rf_hz in sums if rf_hz > 0.0)


def lnbs() -> tuple[FrequencyRange, ...]:
    """Return the common converters."""
    return _rows()["lnb"]


def receivers() -> tuple[FrequencyRange, ...]:
    """Return the receivers, each with what it tunes."""
    return _rows()["receiver"]


def plans() -> tuple[FrequencyRange, ...]:
    """Return who uses what part of the spectrum."""
    return _rows()["plan"]


@cache
def _rows() -> dict[str, tuple[FrequencyRange, ...]]:
    import tomllib
    from importlib.resources import files

    data = tomllib.loads((files("birdcage.sky") / "data" / "bands.toml").read_text(encoding="utf-8"))
    return {kind: tuple(_span(row) for row in rows) for kind, rows in data.items()}


def _span(row: dict[str, Any]) -> FrequencyRange:
    low_mhz, high_mhz = row.get("if_mhz") or row["rf_mhz"]
    lo_hz = row["lo_mhz"] * 1e6 if "lo_mhz" in row else None
    return FrequencyRange(row["name"], low_mhz * 1e6, high_mhz * 1e6, row["source"], lo_hz, row.get("note", ""))
