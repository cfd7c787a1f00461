"""A map without the place where it was made: rounded to whole degrees, and without what would tell it better."""

from __future__ import annotations

from dataclasses import replace

from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import SkyMap

TOLD = (
    "dish", "firmware", "feed", "source_label", "target", "latitude_deg", "longitude_deg", "height_m", "beam_az_deg",
    "beam_el_deg", "freq_hz", "az_offset_deg", "el_offset_deg", "ca_deg", "an_deg", "aw_deg", "file", "mean_of",
    "minus", "drift_removed",
)  # fmt: skip
"""What files tell of all that is known about a map."""
OWN_WORDS = ("url", "address", "command", "where")
"""Settings of a receiver that name machines or folders."""
BLURRED = "place_blurred"


def is_blurred(sky_map: SkyMap) -> bool:
    """Whether `blurred` made it."""
    return bool(sky_map.about.get(BLURRED))


def tells_directions(sky_map: SkyMap) -> bool:
    """Whether a file may say azimuth and elevation.

    Those of a moving target tell the place to some kilometres. A map around one that was made from several maps has
    none: each of them was heard in another direction.
    """
    combined = made_from(sky_map, "mean_of") or made_from(sky_map, "minus")
    return sky_map.plan.frame is not MapFrame.TARGET or not (is_blurred(sky_map) or combined)


def blurred(sky_map: SkyMap) -> SkyMap:
    """Return it with latitude and longitude in whole degrees, for files that others will see.

    Without height, predicted directions, reference crosses, addresses in settings, and the name of a file that it was
    read from. What was heard stays: the satellites of the arc, or the Sun at a known time, can still reveal the place.
    """
    about = {name: sky_map.about[name] for name in TOLD if name in sky_map.about and name not in ("height_m", "file")}
    place = sky_map.place()
    if place is not None:
        about["latitude_deg"], about["longitude_deg"] = (round(each) + 0.0 for each in place)
    for name in ("mean_of", "minus"):
        if name in about:
            about[name] = [each if isinstance(each, int) else "a file" for each in made_from(sky_map, name)]
    settings = tuple(
        {name: value for name, value in each.items() if name not in OWN_WORDS} for each in sky_map.settings
    )
    samples = tuple(replace(each, aim_az_deg=None, aim_el_deg=None) for each in sky_map.samples)
    return replace(sky_map, about={**about, BLURRED: True}, settings=settings, samples=samples, crosses=())


def made_from(sky_map: SkyMap, name: str) -> list[object]:
    """Return which maps it is the `mean_of`, or was made by subtracting (`minus`): numbers, or names of files."""
    told = sky_map.about.get(name)
    return list(told) if isinstance(told, list | tuple) else []
