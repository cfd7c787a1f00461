"""How far a compass needle points off true north."""

from __future__ import annotations

from datetime import UTC, date, datetime
from functools import lru_cache

BEGINS, ENDS = 2025.0, 2030.0
"""The years for which this model is made."""
_MODEL = datetime(2025, 1, 1, tzinfo=UTC)


def declination_deg(when: datetime, latitude_deg: float, longitude_deg: float, height_m: float = 0.0) -> float | None:
    """Return the magnetic declination in degrees, east positive, by the World Magnetic Model (WMM2025, NOAA and BGS).

    It is good to about 0.4 degrees; iron nearby is not in it. None outside the years 2025 to 2029, and near the
    magnetic poles, where a needle does not show a direction. ValueError for no place.
    """
    if not (abs(latitude_deg) <= 90.0 and abs(longitude_deg) <= 360.0):
        raise ValueError(f"no place on Earth: latitude {latitude_deg}, longitude {longitude_deg}")
    return _by_model(when.date(), latitude_deg, longitude_deg, height_m)


@lru_cache(maxsize=8)
def _by_model(day: date, latitude_deg: float, longitude_deg: float, height_m: float) -> float | None:
    """Ask the model, once for each day and place: it is shown again and again."""
    from pygeomag import GeoMag, decimal_year_from_date  # type: ignore[import-untyped]

    year = decimal_year_from_date(day)
    if not BEGINS <= year <= ENDS:
        return None
    model = GeoMag(base_year=_MODEL)
    east = (longitude_deg + 180.0) % 360.0 - 180.0
    field = model.calculate(glat=latitude_deg, glon=east, alt=height_m / 1000.0, time=year)
    return None if field.in_blackout_zone else float(field.d)
