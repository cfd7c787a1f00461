"""The observer during a search: turning with the Earth under satellites that stay in SGP4's frame.

The sine of the elevation, S = g / rho, is what the search works with: g = p . up is the height of a satellite over the
observer's horizontal plane, p = r - observer, rho = |p|. Times are seconds from the start of the search, lengths are
km; vectors are three rows (x, y, z), each of any one shape.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from birdcage.sky.dut1 import LEAP_S
from birdcage.sky.frames import SIDEREAL_RATE_RAD_S, Floats, SiteVectors, dut1_at, sidereal_rad
from birdcage.sky.observer import Observer


@dataclass(frozen=True, slots=True)
class Course:
    """How the elevation moves at a number of moments."""

    sine: Floats
    """S."""
    rate: Floats
    """dS/dt."""
    bend: Floats
    """d2S/dt2."""
    turn: Floats
    """N = rho^3 dS/dt: has the zeros of dS/dt, and is nearly linear in time even at the zenith."""
    turn_rate: Floats
    """dN/dt."""


@dataclass(frozen=True, slots=True)
class ObserverTrack:
    """One observer from one moment on."""

    site: SiteVectors
    start_s: float
    """POSIX seconds of the start of the search."""
    angle_rad: float
    """Local sidereal time at the start."""
    rate_rad_s: float
    """How fast local sidereal time runs: UT1 drifts against UTC, which for a distant satellite is 10 ms in a day."""
    sin_mask: float
    """The sine of the elevation that counts as up."""

    @classmethod
    def of(cls, observer: Observer, start_s: float, span_s: float, min_elevation_deg: float) -> ObserverTrack:
        """Return the ground for a search that starts at `start_s` (POSIX)."""
        site = SiteVectors.of(observer)
        begin, end = dut1_at([start_s, start_s + span_s]).tolist()
        if end - begin > LEAP_S:
            end -= 1.0  # neither POSIX time nor SGP4 counts the leap second
        angle = float(sidereal_rad(start_s, begin)) + site.longitude_rad
        rate = SIDEREAL_RATE_RAD_S * (1.0 + (end - begin) / span_s)
        return cls(site, start_s, angle, rate, math.sin(math.radians(min_elevation_deg)))

    def turned(self, t: Floats) -> tuple[Floats, Floats]:
        """Return cosine and sine of the local sidereal time."""
        angle = self.angle_rad + self.rate_rad_s * t
        return np.cos(angle), np.sin(angle)

    def sine(self, t: Floats, r: Floats) -> Floats:
        """Return S for positions `r`."""
        c, s = self.turned(t)
        px, py, pz = r[0] - self.site.axis_km * c, r[1] - self.site.axis_km * s, r[2] - self.site.north_km
        g = self.site.cos_lat * (px * c + py * s) + self.site.sin_lat * pz
        sine: Floats = g / np.sqrt(px * px + py * py + pz * pz)
        return sine

    def sine_and_turn(self, t: Floats, r: Floats, v: Floats) -> tuple[Floats, Floats]:
        """Return S and N (see `Course`) for positions and velocities."""
        site, w = self.site, self.rate_rad_s
        c, s = self.turned(t)
        across = site.axis_km * w
        px, py, pz = r[0] - site.axis_km * c, r[1] - site.axis_km * s, r[2] - site.north_km
        qx, qy, qz = v[0] + across * s, v[1] - across * c, v[2]
        g = site.cos_lat * (px * c + py * s) + site.sin_lat * pz
        g1 = site.cos_lat * ((qx + w * py) * c + (qy - w * px) * s) + site.sin_lat * qz
        rho2 = px * px + py * py + pz * pz
        sine: Floats = g / np.sqrt(rho2)
        turn: Floats = g1 * rho2 - g * (px * qx + py * qy + pz * qz)
        return sine, turn

    def course(self, t: Floats, r: Floats, v: Floats, a: Floats) -> Course:
        """Return how S moves, for positions, velocities and accelerations."""
        site, w = self.site, self.rate_rad_s
        c, s = self.turned(t)
        across = site.axis_km * w
        px, py, pz = r[0] - site.axis_km * c, r[1] - site.axis_km * s, r[2] - site.north_km
        qx, qy, qz = v[0] + across * s, v[1] - across * c, v[2]
        ax, ay, az = a[0] + across * w * c, a[1] + across * w * s, a[2]
        # up turns: up' = w x up, so g' = q.up + p.up' and g'' = a.up + 2 q.up' + p.up''
        g = site.cos_lat * (px * c + py * s) + site.sin_lat * pz
        g1 = site.cos_lat * ((qx + w * py) * c + (qy - w * px) * s) + site.sin_lat * qz
        g2 = (
            site.cos_lat * ((ax + 2.0 * w * qy - w * w * px) * c + (ay - 2.0 * w * qx - w * w * py) * s)
            + site.sin_lat * az
        )
        rho2 = px * px + py * py + pz * pz
        rho = np.sqrt(rho2)
        pq = px * qx + py * qy + pz * qz
        pq1 = qx * qx + qy * qy + qz * qz + px * ax + py * ay + pz * az
        sine = g / rho
        rho1 = pq / rho
        rate = (g1 - sine * rho1) / rho
        bend = (g2 - 2.0 * rate * rho1 - sine * (pq1 - rho1 * rho1) / rho) / rho
        # N = g' rho^2 - g p.q, so N' = g'' rho^2 + g' p.q - g (p.q)'
        return Course(sine, rate, bend, g1 * rho2 - g * pq, g2 * rho2 + g1 * pq - g * pq1)

    def azimuth_deg(self, t: Floats, r: Floats) -> Floats:
        """Return azimuths, 0 to 360, clockwise from true north."""
        c, s = self.turned(t)
        px, py, pz = r[0] - self.site.axis_km * c, r[1] - self.site.axis_km * s, r[2] - self.site.north_km
        north = self.site.cos_lat * pz - self.site.sin_lat * (c * px + s * py)
        az_deg = np.degrees(np.arctan2(c * py - s * px, north)) % 360.0
        return np.where(az_deg == 360.0, 0.0, az_deg)
