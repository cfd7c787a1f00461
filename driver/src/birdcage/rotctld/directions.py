"""What a client's angles mean: flips and azimuths beyond the circle as one true direction."""

from __future__ import annotations

import math

from birdcage.base.geometry import wrap_360
from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.rprt import RotctldError, Rprt


def pointed(az_deg: float, el_deg: float) -> WishedDirection:
    """Return the direction of a client's angles, in degrees.

    A flip (`P 169.90 156.92`) looks over the zenith: azimuth + 180 and 180 - elevation are the same direction. EINVAL
    for what is no number, and for elevations that no rotator has.
    """
    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise RotctldError(Rprt.EINVAL, f"Azimuth {az_deg}, elevation {el_deg}: those are no angles.")
    if not -90.0 <= el_deg <= 270.0:
        raise RotctldError(
            Rprt.EINVAL, f"Elevation {el_deg:.2f}° is no direction. Send -90 to 90, or to 180 for a flip."
        )
    if el_deg > 90.0:
        az_deg, el_deg = az_deg + 180.0, 180.0 - el_deg
    return WishedDirection(wrap_360(az_deg), el_deg)
