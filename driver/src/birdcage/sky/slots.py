"""The well-known places on the geostationary arc: a table by hand, in `data/slots.toml`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Literal


@dataclass(frozen=True, slots=True)
class Slot:
    """A place on the arc, in degrees east (negative is west), and who is known to stand there."""

    longitude_deg: float
    name: str
    networks: tuple[str, ...] = ()
    """Who uses it: `DISH`, `DIRECTV`, `Bell`, `amateur`, `weather`, `Inmarsat`; empty if that says nothing."""
    band: Literal["Ku", "L", "Ka"] = "Ku"
    """The one that a dish is pointed there for."""
    polarization: Literal["linear", "circular"] | None = None
    """Of its downlink; None if it is not known."""
    tilt_deg: float | None = None
    """By how much its satellites are turned about the line of sight, clockwise as in `birdcage.sky.skew`."""
    aliases: tuple[str, ...] = ()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known to stand there any more."""
        return self.name.startswith("formerly")

    @property
    def label(self) -> str:
        """The longitude as people write it: `101°W`, `28.2°E`."""
        half = "E" if self.longitude_deg >= 0 else "W"
        return f"{abs(self.longitude_deg):g}°{half}"


@cache
def slots() -> tuple[Slot, ...]:
    """Return the table, from west to east. Satellites move house: a name is a hint."""
    import tomllib
    from importlib.resources import files

    text = (files("birdcage.sky") / "data" / "slots.toml").read_text(encoding="utf-8")
    lists = ("networks", "aliases")
    return tuple(
        Slot(**{**row, **{key: tuple(row.get(key, ())) for key in lists}}) for row in tomllib.loads(text)["slot"]
    )
