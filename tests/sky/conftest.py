"""Astropy as the oracle, kept off the network."""

from __future__ import annotations

import pytest


@pytest.fixture(scope="session")
def sky_by_astropy():
    """A function (body, place, time) -> (az, el, range in km) by astropy on the same excerpt of DE421."""
    from importlib.resources import files

    import astropy.units as u
    from astropy.coordinates import AltAz, EarthLocation, SkyCoord, get_body, solar_system_ephemeris
    from astropy.time import Time
    from astropy.utils import iers

    excerpt = files("birdcage.sky") / "data" / "de421_2020_2053.bsp"

    def look(what, observer, when):
        with (
            iers.conf.set_temp("auto_download", False),
            iers.conf.set_temp("auto_max_age", None),
            solar_system_ephemeris.set(str(excerpt)),
        ):
            place = EarthLocation.from_geodetic(
                observer.longitude_deg * u.deg, observer.latitude_deg * u.deg, observer.height_m * u.m
            )
            time = Time(when)
            body = get_body(what, time, place) if isinstance(what, str) else SkyCoord(*what)
            seen = body.transform_to(AltAz(obstime=time, location=place))
            far = seen.distance.to_value(u.km) if isinstance(what, str) else None
            return float(seen.az.deg), float(seen.alt.deg), far

    return look
