"""What lies on a map: the horizon, the Sun's path, satellites of the arc, the dish and its beam, the next direction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from birdcage.base.beam import Beam
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.plan import MapFrame

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_overlay import MapOverlay

SUN_EVERY_MIN = 6
MOST_CLEAR = 3
"""Rows between a satellite and its name, at most: the name leaves the loud spot free."""
MARK, SUN_SIGN = "◆", "☼"


@dataclass(frozen=True, slots=True)
class NamedSpot:
    """A satellite of the arc, or the target of a map around one: then its angles are offsets."""

    label: str
    az_deg: float
    el_deg: float


def slots_over(place: SitePlace) -> tuple[NamedSpot, ...]:
    """Return the slots in Ku band that stand over a place, as they are seen."""
    from birdcage.signal.slots_heard import seen_from
    from birdcage.sky.observer import Observer

    seen = seen_from(Observer(place.latitude_deg, place.longitude_deg), "radio")
    return tuple(NamedSpot(each.slot.label, each.az_deg, each.el_deg) for each in seen)


def sun_path(place: SitePlace, day: datetime) -> list[tuple[float, float]]:
    """Return where the Sun stands over a place in the 24 hours around a moment: azimuth and elevation."""
    from birdcage.sky.sun import sun

    begin = day.astimezone(UTC) - timedelta(hours=12)
    times = (begin + timedelta(minutes=each) for each in range(0, 24 * 60 + 1, SUN_EVERY_MIN))
    return [sun(each, place.latitude_deg, place.longitude_deg) for each in times]


def draw_horizon(overlay: MapOverlay, chart: MapChart, mask: HorizonMask) -> None:
    """Draw the line of trees and roofs."""
    if not mask.is_line or chart.plan.frame is MapFrame.TARGET:
        return
    canvas = Braille(chart.width, chart.height)
    columns = chart.width * 2
    rows = [chart.y(mask.at(chart.left_deg + (x + 0.5) / columns * chart.wide_deg)) * 4.0 for x in range(columns)]
    canvas.trace([(float(x), y) for x, y in enumerate(rows)], "text")
    overlay.lines(canvas)


def draw_sun_path(overlay: MapOverlay, chart: MapChart, path: Sequence[tuple[float, float]]) -> None:
    """Draw the Sun's way as dots; it may enter and leave the picture several times."""
    if chart.plan.frame is MapFrame.TARGET:
        return
    canvas, run = Braille(chart.width, chart.height), list[tuple[float, float]]()
    before: float | None = None
    for az_deg, el_deg in path:
        x_deg = chart.unrolled(az_deg)
        if before is not None and abs(x_deg - before) > 180.0:
            canvas.dotted(run, "target", 3.0)
            run = []
        before = x_deg
        run.append((chart.x(x_deg) * 2.0, chart.y(el_deg) * 4.0))
    canvas.dotted(run, "target", 3.0)
    overlay.lines(canvas)


def draw_names(overlay: MapOverlay, chart: MapChart, slots: Sequence[NamedSpot], beam_deg: float) -> None:
    """Mark every one in the region, and name as many as have room, so that no name lies on another.

    A name stands above or below the spot, which is about as high as the beam is wide.
    """
    spots = [(*chart.spot(each.az_deg, each.el_deg), each.label) for each in slots]
    inside = sorted((x, y, label) for x, y, label in spots if chart.holds(x, y))
    for x, y, _label in inside:
        overlay.put(int(x), int(y), MARK, "strong")
    clear = min(max(round(beam_deg * 0.8 / chart.tall_deg * chart.height) + 1, 1), MOST_CLEAR)
    rows = [sign * row for row in (*range(clear, MOST_CLEAR + 2), *range(clear - 1, 0, -1)) for sign in (-1, 1)]
    for x, y, label in _spread(inside):
        name = label.replace("°", "")
        for up in rows:
            left = int(x) - len(name) // 2
            left = min(max(left, 0), chart.width - len(name))
            if overlay.is_free(left - 1 if left else 0, int(y) + up, min(len(name) + 2, chart.width - left)):
                overlay.put(left, int(y) + up, name, "text")
                break


def _spread(spots: Sequence[tuple[float, float, str]]) -> list[tuple[float, float, str]]:
    """Return them so that the first ones lie far apart: whoever comes late may find no room."""
    order, left = list[tuple[float, float, str]](), list(spots)
    stride = 1 << max(len(left).bit_length() - 1, 0)
    while stride:
        order += [each for each in left[::stride] if each not in order]
        stride //= 2
    return order


def draw_beam(canvas: Braille, chart: MapChart, spot: tuple[float, float], beam: Beam, el_deg: float) -> None:
    """Draw the beam at half power around a spot; on a map in azimuth it is as much wider as it is high."""
    stretch = 1.0 if chart.plan.frame is MapFrame.TARGET else 1.0 / max(math.cos(math.radians(el_deg)), 0.02)
    across = beam.az_deg / 2.0 * stretch / chart.wide_deg * chart.width * 2.0
    up = beam.el_deg / 2.0 / chart.tall_deg * chart.height * 4.0
    if across >= 2.0 and up >= 2.0:
        canvas.ellipse(spot[0] * 2.0 - 0.5, spot[1] * 4.0 - 0.5, across, up, "accent")
