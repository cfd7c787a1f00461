"""Where elements come from: groups by name, each with its address.

CelesTrak's groups and query (`gp.php?GROUP=...&FORMAT=JSON`, OMM in JSON) are those of its page *Current Data*
(celestrak.org/NORAD/elements); it updates nothing more often than every two hours and answers sooner requests with 403.
JSON, as catalogue numbers beyond 69,999 are in no TLE.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.errors import ConfigError

CELESTRAK = "https://celestrak.org/NORAD/elements/gp.php?GROUP={group}&FORMAT=JSON"
SATNOGS = "https://db.satnogs.org/api/tle/?format=json"
"""The TLE that SatNOGS DB holds for each satellite (`tle0`, `tle1`, `tle2`, `tle_source`, `updated`)."""

POLITE_S = 2 * 3600.0
"""How often the same may be asked of a public server."""

GROUPS: dict[str, str] = {
    "stations": "space stations",
    "weather": "weather satellites",
    "amateur": "amateur radio",
    "geo": "geostationary",
    "visual": "the brightest",
    "noaa": "NOAA",
    "goes": "GOES",
    "resource": "Earth resources",
    "sarsat": "search and rescue",
    "dmc": "disaster monitoring",
    "tdrss": "data relay (TDRSS)",
    "argos": "Argos data collection",
    "planet": "Planet",
    "spire": "Spire",
    "intelsat": "Intelsat",
    "ses": "SES",
    "eutelsat": "Eutelsat",
    "telesat": "Telesat",
    "iridium-NEXT": "Iridium",
    "starlink": "Starlink",
    "oneweb": "OneWeb",
    "orbcomm": "Orbcomm",
    "globalstar": "Globalstar",
    "gnss": "navigation, all systems",
    "gps-ops": "GPS",
    "glo-ops": "GLONASS",
    "galileo": "Galileo",
    "beidou": "Beidou",
    "sbas": "navigation overlays",
    "cubesat": "CubeSats",
    "science": "space and Earth science",
    "geodetic": "geodetic",
    "engineering": "engineering",
    "education": "education",
    "military": "miscellaneous military",
    "radar": "radar calibration",
    "last-30-days": "launched in the last 30 days",
    "active": "every active satellite, over ten thousand",
    "satnogs": "all that SatNOGS DB observes",
}
"""What there is by name, and in words. All but `satnogs` are CelesTrak's own names."""

DEFAULT_GROUPS = ("stations", "weather", "amateur", "geo")
"""Fetched by default."""


@dataclass(frozen=True, slots=True)
class Source:
    """A group that can be fetched."""

    name: str
    url: str
    polite_s: float = POLITE_S
    """How long to wait before the same is asked again."""


def find_sources(names: tuple[str, ...], *, mirror_url: str | None = None) -> tuple[Source, ...]:
    """Return where these groups are fetched. ConfigError for a name that is none, with the nearest one.

    With `mirror_url`, whose `{group}` stands for the name, everything comes from there, any name is good, and no one
    but its owner says how often it may be asked.
    """
    return tuple(_source(name, mirror_url) for name in dict.fromkeys(names))


def _source(name: str, mirror_url: str | None) -> Source:
    from urllib.parse import quote

    if mirror_url is not None:
        return Source(name, mirror_url.replace("{group}", quote(name, safe="")), polite_s=0.0)
    known = {each.casefold(): each for each in GROUPS}
    exact = known.get(name.casefold())
    if exact is None:
        from birdcage.base.config.value import did_you_mean

        meant = did_you_mean(name, GROUPS) or "."
        raise ConfigError(f"No group is called {name}{meant} `birdcage elements list --groups` shows them all.")
    return Source(exact, SATNOGS if exact == "satnogs" else CELESTRAK.replace("{group}", quote(exact)))
