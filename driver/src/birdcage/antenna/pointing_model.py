"""The geometry of a mount that is not quite upright and a beam that is not quite square to it.

Terms and signs are those of P. T. Wallace's TPOINT for an altazimuth mount, where the sum of the corrections is the
true angle minus the mount's (first order, A azimuth, E elevation):

    CA  dA = -CA sec E                                  the beam looks to the left of the elevation circle
    AN  dA = -AN sin A tan E    dE = -AN cos A          the azimuth axis leans to the north
    AW  dA = -AW cos A tan E    dE = +AW sin A          the azimuth axis leans to the west

TPOINT's index terms are the offsets of `Alignment`: IA = -az_offset, IE = +el_offset. Those formulas fail near the
zenith; here the same terms turn vectors, which is exact everywhere and the same to first order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.base.geometry import wrap_360


@dataclass(frozen=True, slots=True)
class PointingModel:
    """Collimation and tilt, in degrees. Speaks of the mount's own circles after the index offsets."""

    ca_deg: float = 0.0
    """How far the beam looks to the left (counter-clockwise from above), the same at every elevation."""
    an_deg: float = 0.0
    """How far the azimuth axis leans to the north."""
    aw_deg: float = 0.0
    """How far it leans to the west."""

    @property
    def tilt_deg(self) -> float:
        """How far the azimuth axis is off the vertical."""
        return math.hypot(self.an_deg, self.aw_deg)

    @property
    def largest_shift_deg(self) -> float:
        """No direction is moved by more than this on the sky."""
        return abs(self.ca_deg) + self.tilt_deg

    def to_true(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return where the beam looks with the mount's circles at these angles; azimuth in [0, 360)."""
        ca, el = math.radians(self.ca_deg), math.radians(el_deg)
        forward, left, up = math.cos(ca) * math.cos(el), math.sin(ca), math.cos(ca) * math.sin(el)
        az = math.radians(az_deg) - math.atan2(left, forward)
        az, el = self._leaned(az, math.hypot(forward, left), up, math.radians(self.tilt_deg))
        return wrap_360(math.degrees(az)), math.degrees(el)

    def to_mount(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the mount's angles for a true direction: the inverse of `to_true`, azimuth in [0, 360).

        A beam that looks aside cannot reach the last `ca_deg` around the mount's own zenith: there, the nearest
        direction that it can reach.
        """
        el = math.radians(el_deg)
        az, el = self._leaned(math.radians(az_deg), math.cos(el), math.sin(el), -math.radians(self.tilt_deg))
        left = math.sin(math.radians(self.ca_deg))
        forward = math.sqrt(max(0.0, math.cos(el) ** 2 - left**2))
        mount_el = math.atan2(math.sin(el), forward)
        return wrap_360(math.degrees(az + math.atan2(left, forward))), math.degrees(mount_el)

    def _leaned(self, az: float, level: float, up: float, by: float) -> tuple[float, float]:
        """Lean a direction (azimuth, its horizontal and its vertical part) towards where the axis leans; radians."""
        towards = math.atan2(-self.aw_deg, self.an_deg)
        along, across = level * math.cos(az - towards), level * math.sin(az - towards)
        along, up = along * math.cos(by) + up * math.sin(by), up * math.cos(by) - along * math.sin(by)
        return towards + math.atan2(across, along), math.atan2(up, math.hypot(along, across))


def tilt_of_base(pitch_deg: float, roll_deg: float, front_az_deg: float) -> tuple[float, float]:
    """Return AN and AW of a base whose front, at this true azimuth, is up by `pitch` and right side down by `roll`."""
    front = math.radians(front_az_deg)
    north = -pitch_deg * math.cos(front) - roll_deg * math.sin(front)
    east = -pitch_deg * math.sin(front) + roll_deg * math.cos(front)
    return north, -east
