"""The beam by the Sun in a map, and by how much the Sun rises over the sky: system temperature and G/T.

All in linear power. Fitted, by least squares, to the middle of the beam and to the sky well outside of it:

    p = floor + slope (el - el of the Sun) + rise exp(-(q + k q^2)),  q = 4 ln 2 ((x - x0)^2 / wx^2 + (y - y0)^2 / wy^2)

x, y: degrees on the sky right of the Sun and above it. k lets the flanks be steeper or flatter than a Gaussian's, so
that the width at half power is that of the beam and not of the formula. The disc of the Sun widens it: second moments
add, so that w^2 = w_seen^2 - ln 2 / 2 D^2 for a Gaussian beam and an even disc of diameter D.

    Y = (floor + rise) / floor
    T = T_sun (1 - exp(-x)) / (Y - 1)
    G/T = 4 pi (Y - 1) / (T_sun Omega) x / (1 - exp(-x))

with x = ln 2 D^2 / (wx wy), Omega the solid angle of the disc: the usual G/T = 8 pi k (Y - 1) L / (lambda^2 S), with
the flux S = 2 k T_sun Omega / lambda^2. See `docs/decisions/0076-beam-and-noise-by-the-sun.md`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.geometry import offset, separation
from birdcage.sky.downlinks_hearing import BANDS_HZ
from birdcage.sky.rise import quiet_sun_k
from birdcage.sky.sun import sun
from birdcage.skymap.known_sources import arc_over, observer_of
from birdcage.skymap.map_levels import LessonRefused, values_of
from birdcage.skymap.plan import MapFrame
from birdcage.skymap.sun_fit import SunPoint, fit_sun

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.signal.level_scale import LevelScale
    from birdcage.sky.observer import Observer
    from birdcage.skymap.sky_map import MapSample, SkyMap
    from birdcage.tracking.planning.refraction import Refraction

SUN_DEG = 0.533
"""Diameter of the Sun at its mean distance: 2 asin(695,700 km / 1 au), within 1.7 % all year."""
SUN_LEAST, SUN_MOST = 0.9, 1.5
"""By which factor the Sun may be fainter or brighter than the quiet one of the table: how well its figure is read, and
an active Sun (assumed). At 9.4 GHz the minima of five cycles agree within 7 %, and years of many spots add some tens of
percent (M. Shimojo and others, Publications of the Astronomical Society of Japan 69, 63, 2017)."""
REACH_BEAMS = 4.0
"""What is further from the Sun says nothing of it."""
SLOT_BEAMS = 1.3
"""So near to a slot its satellites are heard beside the Sun."""
NO_SCALE = (
    "This map is in counts, and counts are no power. Set two known levels first: `birdcage levels set 401=0 445=12.5`."
)


@dataclass(frozen=True, slots=True)
class NoiseFound:
    """What the rise of the Sun tells of the receiver."""

    freq_hz: float
    sun_k: float
    """Brightness of the quiet Sun there."""
    system_k: float
    system_span_k: tuple[float, float]
    """For a Sun at the least and at the most of what it may be."""
    gt_db: float
    """G/T in dB per kelvin."""
    gt_span_db: tuple[float, float]


@dataclass(frozen=True, slots=True)
class SunLesson:
    """What came out. Widths in degrees on the sky, at half power, without the Sun's own disc."""

    az_deg: float
    el_deg: float
    az_sigma_deg: float
    el_sigma_deg: float
    right_deg: float
    """Where the Sun was heard, right of where it stood."""
    up_deg: float
    rise_db: float
    """Of the Sun over the sky at its elevation: Y."""
    rise_sigma_db: float
    noise: NoiseFound | None
    """None where the frequency is not known."""
    points: int
    freq_hz: float | None


def teach_sun(
    sky_map: SkyMap, scale: LevelScale | None = None, freq_hz: float | None = None,
    otherwise: Observer | None = None, refraction: Refraction = "radio", beam: Beam | None = None,
) -> SunLesson:  # fmt: skip
    """Return what the Sun in a map tells.

    `scale` makes decibels of counts. `freq_hz`, the place `otherwise` and `beam` hold where the map does not
    tell its own. LessonRefused, with the reason, where it tells nothing.
    """
    if not sky_map.decibels and scale is None:
        raise LessonRefused(NO_SCALE)
    told = sky_map.about.get("freq_hz")
    freq_hz = float(told) if isinstance(told, int | float) else freq_hz
    samples, points = _points(sky_map, otherwise, refraction, freq_hz, beam)
    powers = values_of(tuple(samples), sky_map.decibels, scale)
    seen = [SunPoint(right, up, float(power)) for (right, up), power in zip(points, powers, strict=True)]
    fit = fit_sun(seen)
    az_deg, el_deg = (_without_disc(width) for width in (fit.az_deg, fit.el_deg))
    ratio = fit.rise / fit.floor
    return SunLesson(
        az_deg, el_deg, fit.az_sigma_deg, fit.el_sigma_deg, fit.right_deg, fit.up_deg,
        10.0 * math.log10(1.0 + ratio), 10.0 / math.log(10.0) * fit.ratio_sigma / (1.0 + ratio),
        None if freq_hz is None else _noise(ratio, az_deg, el_deg, freq_hz), len(seen), freq_hz,
    )  # fmt: skip


def _without_disc(width_deg: float) -> float:
    """Return the width of the beam alone."""
    left = width_deg**2 - math.log(2.0) / 2.0 * SUN_DEG**2
    if left <= 0.0:
        raise LessonRefused(f"The source is {width_deg:.2f}° wide, less than the Sun itself. It is not the Sun.")
    return math.sqrt(left)


def _noise(ratio: float, az_deg: float, el_deg: float, freq_hz: float) -> NoiseFound | None:
    """Return system temperature and G/T by Y - 1; None outside the table of the quiet Sun."""
    sun_k = quiet_sun_k(freq_hz)
    if sun_k is None:
        return None
    covered = math.log(2.0) * SUN_DEG**2 / (az_deg * el_deg)
    share = 1.0 - math.exp(-covered)
    disc = math.pi * math.radians(SUN_DEG / 2.0) ** 2

    def system(bright_k: float) -> float:
        return bright_k * share / ratio

    def gt_db(bright_k: float) -> float:
        return 10.0 * math.log10(4.0 * math.pi * ratio / (bright_k * disc) * covered / share)

    low, high = SUN_LEAST * sun_k, SUN_MOST * sun_k
    return NoiseFound(
        freq_hz, sun_k, system(sun_k), (system(low), system(high)), gt_db(sun_k), (gt_db(high), gt_db(low))
    )


def _points(
    sky_map: SkyMap, otherwise: Observer | None, refraction: Refraction, freq_hz: float | None, beam: Beam | None
) -> tuple[list[MapSample], list[tuple[float, float]]]:
    """Return the samples that tell of the Sun, and how far right of it each was, and above it."""
    if sky_map.plan.frame is MapFrame.TARGET:
        target = str(sky_map.about.get("target") or "")
        if target.casefold() != "sun":
            raise LessonRefused(f"This map is around {target or 'a moving target'}. This needs one around the Sun.")
    heard = [sample for sample in sky_map.samples if sample.utc is not None]
    if not heard:
        raise LessonRefused("The map does not tell when its directions were heard, so the Sun can't be placed.")
    if all(sample.aim_az_deg is not None for sample in heard):
        places = [(float(sample.aim_az_deg or 0.0), float(sample.aim_el_deg or 0.0)) for sample in heard]
        known = sky_map.place() is not None or otherwise is not None
    else:
        places = _sun_at(heard, observer_of(sky_map, otherwise), refraction)
        known = True
    if max(el_deg for _az, el_deg in places) < 0.0:
        raise LessonRefused("The Sun was below the horizon while this map was made.")
    beside = _slots(sky_map, otherwise, refraction, freq_hz) if known else ()
    kept = [(sample, offset(*place, sample.az_deg, sample.el_deg)) for sample, place in zip(heard, places, strict=True)]
    return _clear_of(kept, places, beside, _widths(sky_map, beam))


def _sun_at(heard: Sequence[MapSample], observer: Observer, refraction: Refraction) -> list[tuple[float, float]]:
    from birdcage.tracking.planning.refraction import lift_deg

    places = []
    for sample in heard:
        assert sample.utc is not None, "those without a time were left out"
        az_deg, el_deg = sun(sample.utc, observer.latitude_deg, observer.longitude_deg)
        places.append((az_deg, el_deg + float(lift_deg(el_deg, refraction))))
    return places


def _slots(
    sky_map: SkyMap, otherwise: Observer | None, refraction: Refraction, freq_hz: float | None
) -> Sequence[tuple[float, float]]:
    """Return directions of the slots that may be heard at this frequency."""
    low, high = BANDS_HZ["Ku"]
    if freq_hz is not None and not low <= freq_hz <= high:
        return ()
    return [(seen.az_deg, seen.el_deg) for seen in arc_over(observer_of(sky_map, otherwise), refraction)]


def _widths(sky_map: SkyMap, beam: Beam | None) -> Sequence[float]:
    """Return the widths of the beam, as the map tells them, else of `beam`; none at all where neither is known."""
    told = sky_map.about.get("beam_az_deg"), sky_map.about.get("beam_el_deg")
    known = [float(each) for each in told if isinstance(each, int | float)]
    return known or ([] if beam is None else [beam.az_deg, beam.el_deg])


def _clear_of(
    kept: list[tuple[MapSample, tuple[float, float]]], places: list[tuple[float, float]],
    beside: Sequence[tuple[float, float]], widths: Sequence[float],
) -> tuple[list[MapSample], list[tuple[float, float]]]:  # fmt: skip
    """Leave out what is near a slot. LessonRefused where that is the Sun itself."""
    reach = SLOT_BEAMS * max(widths, default=0.0)
    around = REACH_BEAMS * max(widths, default=90.0)
    kept = [each for each in kept if math.hypot(*each[1]) <= around]
    near = min((separation(*place, *slot) for place in places for slot in beside), default=180.0)
    if near < reach:
        raise LessonRefused(
            f"The Sun stood {near:.1f}° from a satellite of the arc, which is heard with it. "
            "Map it another day: the Sun is near the arc around equinox."
        )
    clear = [
        each for each in kept if all(separation(each[0].az_deg, each[0].el_deg, *slot) >= reach for slot in beside)
    ]
    return [sample for sample, _off in clear], [off for _sample, off in clear]
