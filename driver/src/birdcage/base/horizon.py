"""Writes the horizon of the place that counts, and of the saved place that it is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.config.edit import edit
from birdcage.base.config.sections import HorizonPoint, PlaceSettings
from birdcage.base.places import is_in_use, load_places, replace_place

if TYPE_CHECKING:
    from birdcage.base.paths import Paths


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
