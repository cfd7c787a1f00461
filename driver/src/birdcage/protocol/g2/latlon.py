"""The calculator of the dish's place, `LATLON>` (docs/reference/g2-commands.md, *LATLON>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.protocol.trk.reading import END, find, search
from birdcage.protocol.trk.room import Room

_CALCULATE_S = 5.0
_ROUNDING_DEG = 0.015
_PLACE = re.compile(rf"\bLat\s*=\s*([-+]?\d+)\s+Lon\s*=\s*([-+]?\d+){END}")
_ENTERED = re.compile(rf"anglesentered\s*=\s*([-+]?\d+)\s+([-+]?\d+)\s+([-+]?\d+)\s+([-+]?\d+){END}")


class LatLon(Room):
    """Works out a place from the look angles of two geostationary satellites. Sets nothing."""

    menu: ClassVar[str] = "latlon"

    def triangulate(self, p1: float, p2: float, p3: float, p4: float) -> tuple[float, float]:
        """Send four angles in degrees (`l`) and return latitude and longitude in degrees.

        What the four are is not certain: azimuth and elevation of one satellite, then of the other, most likely.
        CommandRefused (`bad_parameter`) when it tells that it took other angles.
        """
        sent = (p1, p2, p3, p4)
        reply = self._run("l " + " ".join(f"{angle:.2f}" for angle in sent), takes_s=_CALCULATE_S)
        place, entered = find(reply, _PLACE), search(reply, _ENTERED)
        angles = tuple(int(text) / 100.0 for text in entered.groups()) if entered else None
        if angles is not None and any(
            abs(took - gave) > _ROUNDING_DEG for took, gave in zip(angles, sent, strict=True)
        ):
            raise CommandRefused(
                f"Of `{reply.command}` the dish took the angles {angles}.", reason=Reason.BAD_PARAMETER
            )
        return int(place[1]) / 100.0, int(place[2]) / 100.0
