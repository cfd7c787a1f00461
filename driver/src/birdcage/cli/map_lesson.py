"""What the lessons of a map share on the command line: the map that is meant, the place, the scale of its source."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.cli.options import wanted

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.signal.level_scale import LevelScale
    from birdcage.sky.observer import Observer
    from birdcage.skymap.sky_map import SkyMap


@dataclass(frozen=True, slots=True)
class MapMeant:
    """A map, and what is known of the dish and place that it was made with."""

    sky_map: SkyMap
    wants: Wanted
    observer: Observer | None
    """The active place, for a map that tells none; None where none is set."""
    scale: LevelScale | None
    """Decibels of its source by two known levels; None where none are kept."""
    feed: str
    """That it was made with; the active one where it does not tell."""


def map_meant(number: int) -> MapMeant:
    """Return the map of that number. StoreError where there is none."""
    from birdcage.cli.say import say
    from birdcage.signal.level_scale import find_scale, load_scales
    from birdcage.sky.observer import Observer
    from birdcage.skymap.map_file import read_map

    wants = wanted()
    sky_map = read_map(wants.paths.signal_recordings, number)
    place, active = wants.settings.place, wants.settings.feed.active
    observer = None
    if place.latitude_deg is not None and place.longitude_deg is not None:
        observer = Observer(place.latitude_deg, place.longitude_deg, place.height_m)
    if sky_map.demo:
        say("DEMO: this map is of a simulated sky.")
    feed = str(sky_map.about.get("feed") or active)
    scale = find_scale(load_scales(wants.paths.known_levels).entries, sky_map.source, feed)
    return MapMeant(sky_map, wants, observer, scale, feed)
