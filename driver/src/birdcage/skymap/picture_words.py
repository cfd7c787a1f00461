"""The words on a picture of a map: title, time and source, ticks, names of satellites."""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import UTC, datetime
from unicodedata import combining, normalize

from birdcage.skymap.place_blur import is_blurred, made_from
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import SkyMap

STEPS_DEG = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0)
WINDS = {0: "N", 45: "NE", 90: "E", 135: "SE", 180: "S", 225: "SW", 270: "W", 315: "NW"}
DRAWN = "°·"
"""Beside ASCII, what the font of the picture has."""
GAP = "  ·  "
ROOM = 0.98
"""Ticks may stand a little closer than wanted, as cells have whole pixels."""


def drawn(text: object) -> str:
    """Return text in letters that the font has: without accents; what is of another script becomes a question mark."""
    letters = "".join(each if each in DRAWN else normalize("NFKD", each) for each in str(text))
    bare = (each for each in letters if not combining(each))
    return "".join(each if " " <= each <= "~" or each in DRAWN else "?" for each in bare)


def title_of(sky_map: SkyMap) -> str:
    """Return what is seen."""
    plan, about = sky_map.plan, sky_map.about
    mean_of, minus = made_from(sky_map, "mean_of"), made_from(sky_map, "minus")
    if len(mean_of) > 1:
        name = f"Mean of maps {', '.join(map(str, mean_of))}"
    elif mean_of or sky_map.number is not None:
        name = f"Sky map {mean_of[0] if mean_of else sky_map.number}"
    else:
        name = str(about.get("file") or "Sky map")
    if minus:
        name += f" minus {', '.join(map(str, minus))}"
    if plan.frame is MapFrame.TARGET:
        return drawn(f"{name}: around {about.get('target') or 'a moving target'}")
    azimuth = f"azimuth {plan.x_low_deg:g} to {plan.x_high_deg:g}°"
    return drawn(f"{name}: {azimuth}, elevation {plan.y_low_deg:g} to {plan.y_high_deg:g}°")


def told_of(sky_map: SkyMap) -> list[str]:
    """Return when and with what it was heard, as far as that is known."""
    about = sky_map.about
    freq_hz = about.get("freq_hz")
    freq = f"{freq_hz / 1e9:.6g} GHz" if isinstance(freq_hz, int | float) else ""
    feed = f"feed {about['feed']}" if about.get("feed") else ""
    drift = "drift taken out" if about.get("drift_removed") else ""
    told = (_when(sky_map), about.get("source_label") or sky_map.source, about.get("dish"), feed, freq, drift)
    return [drawn(each) for each in told if each]


def _when(sky_map: SkyMap) -> str:
    times = [each.utc for each in sky_map.samples if each.utc is not None]
    begun, ended = min(times, default=sky_map.begun), max(times, default=sky_map.ended)
    if begun is None:
        return "time unknown"
    first = _moment(begun)
    if ended is None:
        return f"{first} UTC"
    same_day = begun.astimezone(UTC).date() == ended.astimezone(UTC).date()
    if _moment(ended) == first:
        return f"{first} UTC"
    return f"{first} to {f'{ended.astimezone(UTC):%H:%M}' if same_day else _moment(ended)} UTC"


def _moment(utc: datetime) -> str:
    utc = utc.astimezone(UTC)
    return f"{utc.day} {utc:%b %Y %H:%M}"


def axis_ticks(low: float, high: float, cells_deg: float, a_degree_px: float, least_px: float) -> list[float]:
    """Return where ticks stand on an axis: at least so many pixels apart, and no closer than the cells."""
    wanted = max(least_px / a_degree_px, min(cells_deg, STEPS_DEG[-1])) * ROOM
    return ticks(low, high, next((each for each in STEPS_DEG if each >= wanted), STEPS_DEG[-1]))


def ticks(low: float, high: float, step: float) -> list[float]:
    """Return the multiples of a step from low to high."""
    first, last = math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6)
    return [round(number * step, 9) for number in range(first, last + 1)]


def level_ticks(low: float, high: float, most: int) -> list[float]:
    """Return where ticks stand on a scale of levels: multiples of 1, 2 or 5 times a power of ten, at most so many."""
    if not high > low:
        return [low]
    power = 10.0 ** math.floor(math.log10((high - low) / most))
    step = next(each * power for each in (1.0, 2.0, 5.0, 10.0, 20.0) if (high - low) / (each * power) <= most)
    return ticks(low, high, step)


def axis_names(sky_map: SkyMap) -> tuple[str, str]:
    """Return what the axes are called."""
    if sky_map.plan.frame is MapFrame.TARGET:
        target = drawn(sky_map.about.get("target") or "the target")
        return f"Right of {target}", f"Above {target}"
    return "Azimuth", "Elevation"


def tick_words(sky_map: SkyMap, value: float, *, azimuth: bool) -> str:
    """Return a tick's label; an azimuth has its wind."""
    if sky_map.plan.frame is MapFrame.TARGET:
        return f"{value:+g}°" if value else "0°"
    if not azimuth:
        return f"{value:g}°"
    turned = round(value % 360.0, 6)
    wind = WINDS.get(int(turned), "") if turned == int(turned) else ""
    return f"{turned:g}° {wind}".rstrip()


def satellites_on(sky_map: SkyMap) -> Iterator[tuple[float, float, str, str]]:
    """Yield azimuth as the map counts it, elevation, longitude and name of the satellites on it, highest first.

    None where the place is not known or blurred, and on a map around a target.
    """
    place, plan = sky_map.place(), sky_map.plan
    if place is None or is_blurred(sky_map) or plan.frame is MapFrame.TARGET:
        return
    from birdcage.signal.slots_heard import seen_from
    from birdcage.sky.observer import Observer

    try:
        observer = Observer(*place)
    except ValueError:
        return
    for seen in sorted(seen_from(observer, "radio"), key=lambda each: -each.el_deg):
        turns = math.ceil((plan.x_low_deg - seen.az_deg) / 360.0 - 1e-9)
        az_deg = seen.az_deg + 360.0 * turns
        if az_deg <= plan.x_high_deg and plan.y_low_deg <= seen.el_deg <= plan.y_high_deg:
            yield az_deg, seen.el_deg, seen.slot.label, drawn(seen.slot.name)
