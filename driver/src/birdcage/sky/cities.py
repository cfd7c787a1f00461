"""A built-in list of cities, for a place without a map or a receiver: GeoNames, CC BY 4.0 (see `data/cities.tsv`)."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

_LETTERS = str.maketrans({"ø": "o", "ł": "l", "đ": "d", "ð": "d", "ı": "i", "þ": "th", "æ": "ae", "œ": "oe"})
"""Letters that Unicode does not take apart into a plain one and a mark. Of `ß`, case folding makes `ss`."""


@dataclass(frozen=True, slots=True)
class City:
    """The middle of a city, to about a kilometre. Its height is not known."""

    name: str
    country: str
    """ISO 3166, two letters."""
    region: str
    """GeoNames' own code of the region, only where name and country do not tell it from another; else empty."""
    latitude_deg: float
    longitude_deg: float
    other_name: str = ""

    @property
    def label(self) -> str:
        """What tells it from others: `Springfield, US-MO`."""
        return f"{self.name}, {self.country}{f'-{self.region}' if self.region else ''}"


def search_cities(text: str, limit: int = 10) -> tuple[City, ...]:
    """Return cities whose name, or a word of it, begins with `text`; whole names first, then the largest first.

    Capitals, accents and marks do not count. `paris, us` and `springfield, us-mo` ask for country and region.
    """
    name, _comma, where = (_fold(part) for part in text.partition(","))
    country, _dash, region = where.partition("-")
    if not name:
        return ()
    ranked: list[tuple[int, City]] = []
    for city, keys in _table():
        if (country and country != city.country.casefold()) or (region and region != city.region.casefold()):
            continue
        rank = min((_rank(key, name) for key in keys), default=3)
        if rank < 3:
            ranked.append((rank, city))
    ranked.sort(key=lambda each: each[0])  # stable: within a rank the largest stays first
    return tuple(city for _rank, city in ranked[:limit])


def find_city(text: str) -> City:
    """Return the one city that is meant. ValueError with what to type when there is none, or more than one."""
    found = search_cities(text, 6)
    if not found:
        raise ValueError(
            f"No city called {text.strip()!r} in the list of capitals and cities above 100,000 people. Type a "
            "larger city nearby, a locator, or latitude and longitude."
        )
    wanted = _fold(text.partition(",")[0])
    whole = [city for city in found if wanted in (_fold(city.name), _fold(city.other_name))]
    choice = whole or list(found)
    if len(choice) == 1:
        return choice[0]
    raise ValueError(f"Which one? {'; '.join(_described(city) for city in choice)}.")


def _described(city: City) -> str:
    return f"{city.label} ({city.latitude_deg:.1f}, {city.longitude_deg:.1f})"


def _rank(key: str, wanted: str) -> int:
    if key == wanted:
        return 0
    if key.startswith(wanted):
        return 1
    return 2 if f" {wanted}" in key else 3


def _fold(text: str) -> str:
    """Return a text as it is compared: no marks, no capitals, single blanks, no apostrophes and hyphens."""
    plain = unicodedata.normalize("NFKD", text.casefold().translate(_LETTERS))
    kept = "".join(each for each in plain if not unicodedata.combining(each) and each not in "'’‘`ʻ")
    return " ".join(kept.split())


@cache
def _table() -> tuple[tuple[City, tuple[str, ...]], ...]:
    """Return every city with the names that it is found by; read once, when somebody asks."""
    text = files("birdcage.sky").joinpath("data/cities.tsv").read_text(encoding="utf-8")
    table = []
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        name, other, country, region, latitude, longitude = line.split("\t")
        city = City(name, country, region, float(latitude), float(longitude), other)
        folded = [_fold(each) for each in (name, other) if each]
        table.append((city, tuple({key: None for each in folded for key in (each, each.replace("-", " "))})))
    return tuple(table)
