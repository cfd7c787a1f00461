"""Makes what a map of the world shows: a millisecond or two of work, for a thread other than a face's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from birdcage.sky.elements import ElementSet
from birdcage.sky.footprint import footprint
from birdcage.sky.frames import posix_s
from birdcage.sky.ground_track import orbit_track, sub_points
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import Fleet
from birdcage.sky.terminator import sub_solar
from birdcage.sky.world import SubPoint, WorldView


@dataclass(frozen=True, slots=True)
class Mapped:
    """A satellite to be drawn."""

    elements: ElementSet
    time_offset_s: float = 0.0
    """How much later than computed it comes."""
    favourite: bool = False


def world_view(
    when: datetime, observer: Observer | None, chosen: Mapped | None = None, others: Sequence[Mapped] = ()
) -> WorldView:
    """Return the world at a time (aware; ValueError otherwise).

    Satellites without a position at that time, decayed ones say, are left out.
    """
    t_s = posix_s(when)
    bare = WorldView(when, sub_solar(when), observer, _places(t_s, others))
    if chosen is None:
        return bare
    here = _places(t_s, [chosen])
    if not here:
        return bare
    track = orbit_track(chosen.elements, t_s, chosen.time_offset_s)
    line = np.column_stack([track.latitude_deg, track.longitude_deg])
    fine = np.isfinite(line[:, 0])
    under = (here[0].latitude_deg, here[0].longitude_deg)
    behind, ahead = line[fine & (track.t_s < t_s)].tolist(), line[fine & (track.t_s > t_s)].tolist()
    return WorldView(
        when,
        bare.sun,
        observer,
        bare.satellites,
        here[0],
        (*((lat, lon) for lat, lon in behind), under),
        (under, *((lat, lon) for lat, lon in ahead)),
        footprint(*under, here[0].altitude_km),
    )


def _places(t_s: float, satellites: Sequence[Mapped]) -> tuple[SubPoint, ...]:
    """Return the points under satellites, those that have one, in their order."""
    offsets = {index: one.time_offset_s for index, one in enumerate(satellites) if one.time_offset_s}
    _, position, _ = Fleet([one.elements for one in satellites]).states(t_s, offsets)
    under = sub_points(t_s, position)
    columns = zip(satellites, under.latitude_deg.tolist(), under.longitude_deg.tolist(), under.altitude_km.tolist(),
                  strict=True)  # fmt: skip
    return tuple(
        SubPoint(one.elements.name, one.elements.norad_id, lat, lon, up, one.favourite)
        for one, lat, lon, up in columns
        if np.isfinite(lat)
    )
