"""Places where a dish has stood, each with its own horizon, kept in `places.toml`.

The place that counts stands in `[place]` of `birdcage.toml`; `place_settings` is what is written there to use another.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.config.edit import Value, edit
from birdcage.base.config.sections import HorizonPoint, PlaceSettings
from birdcage.base.geometry import separation
from birdcage.base.named_tables import NamedTables, TablesRead, checked_name, number_of, same

if TYPE_CHECKING:
    from birdcage.base.paths import Paths

HEADER = (
    "# Places with names. Latitude north +, longitude east +; the horizon as [azimuth, elevation] in true degrees.\n"
    "# `birdcage place use NAME` puts one into birdcage.toml.\n\n"
)

SAME_PLACE_DEG = 0.002
"""Some 200 m: beyond it other trees stand around."""


@dataclass(frozen=True, slots=True)
class Place:
    """A place with a name, in WGS84."""

    name: str
    latitude_deg: float
    longitude_deg: float
    height_m: float = 0.0
    """Above the ellipsoid."""
    horizon: tuple[HorizonPoint, ...] = ()


@dataclass(frozen=True, slots=True)
class PlacesRead:
    """What a file holds, as far as it could be read."""

    path: Path
    entries: tuple[Place, ...] = ()
    problems: tuple[str, ...] = ()
    """Sentences with file and line; while there are any, the file is not written."""

    def named(self, name: str) -> Place | None:
        """Return the place of that name, whatever its capitals; None if there is none."""
        return next((place for place in self.entries if same(place.name, name)), None)


def checked_place(
    name: str, latitude_deg: float, longitude_deg: float, height_m: float = 0.0,
    horizon: Sequence[tuple[float, float]] = (),
) -> Place:  # fmt: skip
    """Return a place that may be kept. ValueError says what is wrong with it, in words for a person."""
    name = checked_name(name)
    if not (math.isfinite(latitude_deg) and abs(latitude_deg) <= 90.0):
        raise ValueError("the latitude lies from -90 to 90 degrees")
    if not (math.isfinite(longitude_deg) and abs(longitude_deg) <= 180.0):
        raise ValueError("the longitude lies from -180 to 180 degrees")
    if not (math.isfinite(height_m) and -500.0 <= height_m <= 9000.0):
        raise ValueError("the height lies from -500 to 9000 m")
    for az_deg, el_deg in horizon:
        if not (math.isfinite(az_deg + el_deg) and abs(az_deg) <= 360.0 and abs(el_deg) <= 90.0):
            raise ValueError("a point of the horizon has an azimuth of -360 to 360 and an elevation of -90 to 90")
    return Place(name, latitude_deg, longitude_deg, height_m, tuple(HorizonPoint(*point) for point in horizon))


def load_places(path: Path) -> PlacesRead:
    """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
    return _places(path, _FILE.load(path))


def add_place(path: Path, place: Place) -> PlacesRead:
    """Keep another one.

    This and the two below raise ConfigError, with nothing written: the file is damaged or can't be written, a name is
    there twice or no more.
    """
    return _places(path, _FILE.add(path, place))


def replace_place(path: Path, name: str, place: Place) -> PlacesRead:
    """Put `place` where the one called `name` stands."""
    return _places(path, _FILE.replace(path, name, place))


def remove_place(path: Path, name: str) -> PlacesRead:
    """Take out the one called `name`."""
    return _places(path, _FILE.delete(path, name))


def place_settings(place: Place) -> dict[str, Value]:
    """Return what `base.config.edit` has to write so that this place counts.

    A declination that was typed for another place goes: the World Magnetic Model knows the one here.
    """
    return {
        "place.name": place.name,
        "place.latitude_deg": place.latitude_deg,
        "place.longitude_deg": place.longitude_deg,
        "place.height_m": place.height_m,
        "place.horizon": place.horizon or None,
        "place.declination_deg": None,
    }


def moved_settings(
    here: PlaceSettings, latitude_deg: float, longitude_deg: float, height_m: float | None, name: str | None = None
) -> dict[str, Value]:
    """Return what `base.config.edit` has to write once `[place]` is found to be there. Height None: not known.

    Further than `SAME_PLACE_DEG` on, the name, the horizon, the height and a typed declination of the place before go.
    """
    changes: dict[str, Value] = {"place.latitude_deg": latitude_deg, "place.longitude_deg": longitude_deg}
    if name is not None:
        changes["place.name"] = name
    if height_m is not None:
        changes["place.height_m"] = height_m
    if here.latitude_deg is None or here.longitude_deg is None:
        far = True
    else:
        far = separation(here.longitude_deg, here.latitude_deg, longitude_deg, latitude_deg) > SAME_PLACE_DEG
    elsewhere = dict.fromkeys(("name", "height_m", "horizon", "declination_deg"))
    return {**{f"place.{key}": value for key, value in elsewhere.items()}, **changes} if far else changes


def is_in_use(place: Place, settings: PlaceSettings) -> bool:
    """Return whether `[place]` is this one: by name and by where it is."""
    here = (settings.latitude_deg, settings.longitude_deg)
    return same(place.name, settings.name or "") and here == (place.latitude_deg, place.longitude_deg)


def keep_horizon(paths: Paths, here: PlaceSettings, points: Iterable[tuple[float, float]]) -> str:
    """Write points (true azimuth and elevation, degrees) into `[place]`; none at all: a flat horizon.

    `here` is `[place]` as it counts. Return the name of the saved place that has them too; empty when there is none.
    ConfigError says why they are not kept, or not in both files.
    """
    kept = tuple(HorizonPoint(round(az_deg, 3), round(el_deg, 3)) for az_deg, el_deg in points)
    edit(paths.config_file, {"place.horizon": kept or None})
    saved = next((each for each in load_places(paths.places_file).entries if is_in_use(each, here)), None)
    if saved is None:
        return ""
    replace_place(paths.places_file, saved.name, replace(saved, horizon=kept))
    return saved.name


def _places(path: Path, found: TablesRead[Place]) -> PlacesRead:
    return PlacesRead(path, found.entries, found.problems)


def _read(row: dict[str, object]) -> Place:
    name, horizon = row.get("name"), row.get("horizon", [])
    if not isinstance(name, str):
        raise ValueError("a place has a name")
    if not isinstance(horizon, list):
        raise ValueError("a horizon is a list of [az, el]")
    height_m = number_of(row, "height_m", "metres") if "height_m" in row else 0.0
    points = [_point(point) for point in horizon]
    return checked_place(name, number_of(row, "latitude_deg"), number_of(row, "longitude_deg"), height_m, points)


def _point(value: object) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError("a point of the horizon is [az, el]")
    point = {"az": value[0], "el": value[1]}
    return number_of(point, "az"), number_of(point, "el")


def _cells(place: Place) -> dict[str, object]:
    return {
        "name": place.name,
        "latitude_deg": place.latitude_deg,
        "longitude_deg": place.longitude_deg,
        "height_m": place.height_m,
        "horizon": place.horizon or None,
    }


_FILE = NamedTables("place", "places", HEADER, read=_read, cells=_cells)
