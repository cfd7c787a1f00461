"""Stars and radio sources by name: a table by hand, in `data/stars.toml`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache


@dataclass(frozen=True, slots=True)
class NamedStar:
    """A point of the sky with a name: ICRS, as good as J2000."""

    name: str
    ra_deg: float
    dec_deg: float
    aliases: tuple[str, ...] = ()


@cache
def stars() -> tuple[NamedStar, ...]:
    """Return the table, in its order."""
    import tomllib
    from importlib.resources import files

    from birdcage.sky.targets.angles import angle_deg

    text = (files("birdcage.sky") / "data" / "stars.toml").read_text(encoding="utf-8")
    return tuple(
        NamedStar(row["name"], angle_deg(row["ra"], hours=True), angle_deg(row["dec"]), tuple(row.get("aliases", ())))
        for row in tomllib.loads(text)["star"]
    )
