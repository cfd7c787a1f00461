"""What the commands about places share: finding one, and printing it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.base.config.sections import PlaceSettings
    from birdcage.base.places import Place, PlacesRead
    from birdcage.sky.horizon import HorizonMask


def place_in_use(settings: PlaceSettings) -> Place | None:
    """Return `[place]` as a place; None when it names none."""
    from birdcage.base.places import Place

    latitude, longitude = settings.latitude_deg, settings.longitude_deg
    if latitude is None or longitude is None:
        return None
    return Place(settings.name or "", latitude, longitude, settings.height_m, settings.horizon)


def find_saved(places: PlacesRead, name: str) -> Place:
    """Return the saved place of that name. UsageError when there is none."""
    found = places.named(name)
    if found is None:
        known = ", ".join(each.name for each in places.entries) or "none"
        raise click.UsageError(f'Place "{name}" not found. Saved: {known}.')
    return found


def place_line(place: Place) -> str:
    """Return a place in one line."""
    from birdcage.sky.horizon import horizon_words
    from birdcage.sky.locator import encode

    lat, lon = place.latitude_deg, place.longitude_deg
    where = f"{abs(lat):8.4f} {'N' if lat >= 0 else 'S'} {abs(lon):9.4f} {'E' if lon >= 0 else 'W'}"
    name = place.name or "(no name)"
    return f"{name:20} {encode(lat, lon)} {where} {place.height_m:5.0f} m  {horizon_words(place.horizon)}"


def place_values(place: Place) -> dict[str, object]:
    """Return a place for JSON."""
    from birdcage.sky.locator import encode

    return {
        "name": place.name or None,
        "latitude_deg": place.latitude_deg,
        "longitude_deg": place.longitude_deg,
        "height_m": place.height_m,
        "locator": encode(place.latitude_deg, place.longitude_deg),
        "horizon": [list(point) for point in place.horizon],
    }


def find_place(
    settings: Settings, where: str, lat: float | None, lon: float | None, alt: float | None
) -> tuple[float, float, float, Sequence[tuple[float, float]]]:
    """Return latitude, longitude, height and horizon of what was typed, else of the options, else of `[place]`."""
    from birdcage.cli.sky_options import find_observer
    from birdcage.sky.whereabouts import parse_place

    if where:
        if lat is not None or lon is not None:
            raise click.UsageError("Give WHERE, or --lat and --lon, not both.")
        try:
            found = parse_place(where)
        except ValueError as error:
            raise click.UsageError(str(error)) from None
        return found.latitude_deg, found.longitude_deg, found.height_m if alt is None else alt, ()
    found = find_observer(settings, lat, lon, alt)
    points = settings.place.horizon if lat is None else ()
    return found.latitude_deg, found.longitude_deg, found.height_m, points


def read_mask(file: Path) -> HorizonMask:
    """Return the horizon in a file; what is wrong with it is a wrong command line."""
    from birdcage.sky.horizon_file import read_horizon_file

    try:
        return read_horizon_file(file)
    except ValueError as error:
        raise click.UsageError(str(error)) from None
    except OSError as error:
        raise click.UsageError(f"{file} can't be read ({error.strerror or error}).") from None
