"""The keywords of a map in FITS: grid, times, receiver, place, pointing model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime, timedelta

from birdcage.base.geometry import wrap_360
from birdcage.base.version import version
from birdcage.signal.recordings import DEMO
from birdcage.skymap.place_blur import is_blurred, made_from
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sky_map import SkyMap

Card = tuple[str, str | float | int | bool, str]
"""Keyword, value, comment."""
UNITS = {"counts": "count"}
"""Units that FITS has another word for."""
POINTING = {
    "az_offset_deg": ("PTAZOFF", "[deg] pointing model: azimuth offset"),
    "el_offset_deg": ("PTELOFF", "[deg] pointing model: elevation offset"),
    "ca_deg": ("PTCA", "[deg] pointing model: collimation"),
    "an_deg": ("PTAN", "[deg] pointing model: tilt of the axis to north"),
    "aw_deg": ("PTAW", "[deg] pointing model: tilt of the axis to west"),
}
BLUR_WORDS = (
    "The place is rounded to whole degrees. Right ascension, declination,",
    "galactic coordinates and all else that would tell it better are left out.",
)


def plain(value: object) -> str:
    """Return text as a header of FITS may hold it: printable ASCII."""
    return "".join(each if " " <= each <= "~" else "?" for each in str(value))


def grid_cards(sky_map: SkyMap) -> Iterator[Card]:
    """Yield where the pixels are.

    In azimuth and elevation: plate carree (CAR) with its reference on the horizon, so that both axes are linear.
    astropy knows azimuth as `ALON`. Around a target: plain linear axes, as the zenithal equidistant offsets of a
    target that moves are of no celestial frame.
    """
    plan = sky_map.plan
    if plan.frame is MapFrame.TARGET:
        yield "CTYPE1", "XOFFSET", "right of the target, equidistant"
        yield "CTYPE2", "YOFFSET", "above the target, equidistant"
        yield "CRPIX1", 1.0 - plan.x_low_deg / plan.step_deg, "the target"
        yield "CRVAL1", 0.0, ""
    else:
        middle = (plan.columns - 1) / 2.0
        yield "CTYPE1", "ALON-CAR", "azimuth, clockwise from north"
        yield "CTYPE2", "ALAT-CAR", "elevation"
        yield "CRPIX1", 1.0 + middle, ""
        yield "CRVAL1", wrap_360(plan.x_low_deg + middle * plan.step_deg), "[deg]"
    yield "CRPIX2", 1.0 - plan.y_low_deg / plan.row_step_deg, ""
    yield "CRVAL2", 0.0, "[deg]"
    yield "CDELT1", plan.step_deg, "[deg]"
    yield "CDELT2", plan.row_step_deg, "[deg]"
    yield "CUNIT1", "deg", ""
    yield "CUNIT2", "deg", ""


def image_cards(sky_map: SkyMap) -> Iterator[Card]:
    """Yield all keywords of the image, as far as they are known."""
    yield from grid_cards(sky_map)
    yield "BUNIT", plain(UNITS.get(sky_map.unit, sky_map.unit)), "mean of the readings; NaN: not measured"
    yield from time_cards(sky_map)
    about = sky_map.about
    if (freq_hz := number_of(about, "freq_hz")) is not None:
        yield "FREQ", freq_hz, "[Hz] middle of what is heard, at the antenna"
    az, el = number_of(about, "beam_az_deg"), number_of(about, "beam_el_deg")
    if az is not None and el is not None:
        yield "BMAJ", max(az, el), "[deg] beam at half power"
        yield "BMIN", min(az, el), "[deg]"
        yield "BPA", 90.0 if az > el else 0.0, "[deg] of BMAJ, from elevation to azimuth"
    yield from place_cards(sky_map)
    for name, (keyword, comment) in POINTING.items():
        if (value := number_of(about, name)) is not None:
            yield keyword, value, comment
    yield from name_cards(sky_map)


def time_cards(sky_map: SkyMap) -> Iterator[Card]:
    """Yield when it was heard. A combined map has its begin and end only."""
    known = [(each.utc, each.integration_s or 0.0) for each in sky_map.samples if each.utc is not None]
    begun, ended = sky_map.begun, sky_map.ended
    yield "TIMESYS", "UTC", ""
    if known:
        begun = min(utc - timedelta(seconds=listened_s / 2.0) for utc, listened_s in known)
        ended = max(utc + timedelta(seconds=listened_s / 2.0) for utc, listened_s in known)
        middle = begun + sum((utc - begun for utc, _ in known), timedelta()) / len(known)
        yield "DATE-AVG", stamp(middle), "mean of all directions"
    if begun is not None:
        yield "DATE-OBS", stamp(begun), "begin of the first direction"
    if ended is not None:
        yield "DATE-END", stamp(ended), "end of the last direction"
    told = [each.integration_s for each in sky_map.samples if each.integration_s is not None]
    if told:
        yield "EXPTIME", round(sum(told), 3), "[s] listening in all directions together"


def place_cards(sky_map: SkyMap) -> Iterator[Card]:
    """Yield where it was heard; without height where the place is blurred."""
    place = sky_map.place()
    if place is None:
        return
    rounded = "in whole degrees" if is_blurred(sky_map) else "WGS84"
    yield "OBSGEO-B", place[0], f"[deg] latitude, {rounded}"
    yield "OBSGEO-L", place[1], f"[deg] longitude, east positive, {rounded}"
    if (height_m := number_of(sky_map.about, "height_m")) is not None:
        yield "OBSGEO-H", height_m, "[m] above the ellipsoid"


def name_cards(sky_map: SkyMap) -> Iterator[Card]:
    """Yield what it is called, and whether the sky was simulated."""
    about = sky_map.about
    told = {
        "TELESCOP": (about.get("dish"), "dish"),
        "INSTRUME": (about.get("source_label") or sky_map.source, "signal source"),
        "FEED": (about.get("feed"), "the feed that is fitted"),
        "FIRMWARE": (about.get("firmware"), "of the dish"),
        "OBJECT": (about.get("target") or sky_map.title, ""),
        "FILENAME": (about.get("file"), "where it was read from"),
        "MEANOF": (" ".join(map(str, made_from(sky_map, "mean_of"))), "maps that it is the mean of"),
        "MINUS": (" ".join(map(str, made_from(sky_map, "minus"))), "maps that were subtracted"),
    }
    for keyword, (value, comment) in told.items():
        if value:
            yield keyword, plain(value), comment
    if sky_map.number is not None:
        yield "MAPNUM", sky_map.number, "number of the map"
    yield "ORIGIN", "birdcage", ""
    yield "CREATOR", f"birdcage {version()}", ""
    yield "NHEARD", len(sky_map.samples), "directions heard"
    yield "NCELLS", sky_map.plan.cells, "directions of the grid"
    if about.get("drift_removed"):
        yield "NODRIFT", True, "the drift of gain is taken out"
    yield "LOGSCALE", sky_map.decibels, "equal steps are equal ratios of power"
    yield "SIMULATE", sky_map.demo, "the sky is a simulated one"


def comments_of(sky_map: SkyMap) -> tuple[str, ...]:
    """Return what stands as text in each header."""
    return ((DEMO,) if sky_map.demo else ()) + (BLUR_WORDS if is_blurred(sky_map) else ())


def number_of(about: Mapping[str, object], name: str) -> float | None:
    """Return a number that is known of a map; else None."""
    value = about.get(name)
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


def stamp(utc: datetime) -> str:
    """Return a time as FITS writes it: UTC, without a zone."""
    return utc.astimezone(UTC).replace(tzinfo=None).isoformat(timespec="milliseconds")
