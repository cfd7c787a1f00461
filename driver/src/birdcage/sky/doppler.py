"""The shift of a frequency by motion along the line of sight."""

from __future__ import annotations

LIGHT_KM_S = 299792.458


def doppler_hz(freq_hz: float, range_rate_km_s: float) -> float:
    """Return received minus sent frequency of a downlink; `range_rate_km_s` is positive for what goes away.

    To first order in v/c, which is exact to 6 Hz at 10 GHz for a low orbit.
    """
    return -freq_hz * range_rate_km_s / LIGHT_KM_S
