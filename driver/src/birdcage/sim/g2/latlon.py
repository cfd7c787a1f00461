"""Where am I, from two geostationary satellites: `LATLON>`. Both lines are quoted (noted).

Source: docs/reference/g2-commands.md, *LATLON>*.

That the four parameters are azimuth and elevation of one satellite and then of the other is likely (noted); which
satellites is a setting. Each pair alone gives a place on a spherical Earth; the answer is midway.
"""

from __future__ import annotations

import math

from birdcage.base.geometry import shortest_turn
from birdcage.sim.almanac import EARTH_RADIUS_KM, GEO_RADIUS_KM
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script
from birdcage.sim.trk.limits import number


class LatLonMenu(G2Menu):
    """The calculator."""

    prompt = "LATLON>"
    help_lines = ("help [<command>]", "l <az1> <el1> <az2> <el2> - calculate lat and lon", "q")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"l": self._calculate}

    def _calculate(self, args: list[str]) -> Script:
        given = [number(text) for text in args]
        scale = 100.0 if self.board.settings.latlon_unit == "deg" else 1.0
        angles = [round(angle * scale) for angle in given if angle is not None]
        if len(given) != 4 or len(angles) != 4 or not all(abs(el) <= 9000 for el in angles[1::2]):
            yield from self.bad_parameter()
            return
        lat, lon = self._place([angle / 100.0 for angle in angles])
        yield "anglesentered = {} {} {} {}\n".format(*angles)
        yield f"Lat = {round(lat * 100)} Lon = {round(lon * 100)}\n"

    def _place(self, angles_deg: list[float]) -> tuple[float, float]:
        settings = self.board.settings
        lat1, lon1 = place(settings.latlon_first, angles_deg[0], angles_deg[1])
        lat2, lon2 = place(settings.latlon_second, angles_deg[2], angles_deg[3])
        return (lat1 + lat2) / 2.0, shortest_turn(0.0, lon1 + shortest_turn(lon1, lon2) / 2.0)


def place(slot_deg_east: float, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Return latitude and longitude from which a geostationary slot stands at this azimuth and elevation."""
    az, el = math.radians(az_deg), math.radians(el_deg)
    away = math.acos(EARTH_RADIUS_KM / GEO_RADIUS_KM * math.cos(el)) - el
    lat = math.atan(-math.tan(away) * math.cos(az))
    lon = slot_deg_east - math.degrees(math.atan2(math.sin(az) * math.sin(away), math.cos(away) / math.cos(lat)))
    return math.degrees(lat), shortest_turn(0.0, lon)
