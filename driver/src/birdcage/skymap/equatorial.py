"""Right ascension, declination and galactic coordinates of what was heard, by astropy and without any network."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from birdcage.skymap.sky_map import MapSample

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

ROUNDS = 3
"""So often is the lift of the air computed anew, until the direction without it is exact."""

STEADY_S = 300.0
"""Between times so far apart precession, nutation and aberration are interpolated, which costs no milliarcsecond."""


@contextmanager
def offline() -> Iterator[None]:
    """Keep astropy from asking the internet for the turning of the Earth and leap seconds: it has tables with it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of dates beyond its tables: what that costs is less than an arc second
        from astropy.utils import data, iers  # type: ignore[import-untyped]

        with (
            data.conf.set_temp("allow_internet", False),
            iers.conf.set_temp("auto_download", False),
            iers.conf.set_temp("auto_max_age", None),
            iers.conf.set_temp("iers_degraded_accuracy", "ignore"),
        ):
            yield


def equatorial(
    samples: Sequence[MapSample], latitude_deg: float, longitude_deg: float, height_m: float
) -> tuple[NDArray[np.float64], ...]:
    """Return RA and declination (ICRS), galactic longitude and latitude in degrees; NaN where no time is known.

    The directions are as seen: what the air lifts (`lift_deg`, radio) is taken off before.
    """
    import numpy as np

    from birdcage.tracking.planning.refraction import lift_deg

    found = np.full((4, len(samples)), np.nan)
    timed = [index for index, each in enumerate(samples) if each.utc is not None]
    if timed:
        with offline():
            import astropy.units as u  # type: ignore[import-untyped]
            from astropy.coordinates import AltAz, EarthLocation, SkyCoord  # type: ignore[import-untyped]
            from astropy.coordinates.erfa_astrom import (  # type: ignore[import-untyped]
                ErfaAstromInterpolator,
                erfa_astrom,
            )
            from astropy.time import Time  # type: ignore[import-untyped]

            seen = np.array([samples[index].el_deg for index in timed])
            el = seen
            for _ in range(ROUNDS):
                el = seen - lift_deg(el)
            place = EarthLocation.from_geodetic(longitude_deg * u.deg, latitude_deg * u.deg, height_m * u.m)
            times = Time([samples[index].utc for index in timed], scale="utc")
            az = np.array([samples[index].az_deg for index in timed])
            with erfa_astrom.set(ErfaAstromInterpolator(STEADY_S * u.s)):
                sky = SkyCoord(AltAz(az=az * u.deg, alt=el * u.deg, obstime=times, location=place)).icrs
            galactic = sky.galactic
            found[:, timed] = sky.ra.deg, sky.dec.deg, galactic.l.deg, galactic.b.deg
    return tuple(found)
