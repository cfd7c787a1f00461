"""Sidereal time: which right ascension stands in the south."""

from __future__ import annotations

from datetime import datetime

from birdcage.sky.ephemeris.worker import time_of


def local_sidereal_h(when: datetime, longitude_deg: float) -> float:
    """Return the local apparent sidereal time in hours, 0 to 24 (IAU 2006 precession, IAU 2000A nutation).

    `when` is aware, the longitude positive eastwards. ValueError for a naive time.
    """
    hours = (float(time_of(when).gast) + longitude_deg / 15.0) % 24.0
    return 0.0 if hours == 24.0 else hours


def sidereal_words(hours: float) -> str:
    """Return hours as `19h02m31s`, rounded down."""
    seconds = int(hours * 3600.0) % 86400
    return f"{seconds // 3600:02d}h{seconds // 60 % 60:02d}m{seconds % 60:02d}s"
