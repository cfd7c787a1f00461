"""Draws a proposed horizon over the map: its line, and each point as accepted or not."""

from __future__ import annotations

from itertools import pairwise

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.shown.map_offer import MapOffer
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_overlay import MapOverlay

ACCEPTED, OPEN, CURSOR = "●", "○", "╋"


def draw_offer(overlay: MapOverlay, chart: MapChart, offer: MapOffer) -> None:
    """Draw it; the point under the cursor lies on top."""
    spots = [chart.spot(each.az_deg, each.el_deg) for each in offer.points]
    # A point on the edge of the map is on its last cell.
    spots = [(min(max(x, 0.0), chart.width - 0.01), min(max(y, 0.0), chart.height - 0.01)) for x, y in spots]
    for index, (x, y) in enumerate(spots):
        if index != offer.at:
            overlay.put(int(x), int(y), ACCEPTED if index in offer.accepted else OPEN, "strong")
    x, y = spots[offer.at]
    overlay.put(int(x), int(y), CURSOR, "target-strong")
    canvas = Braille(chart.width, chart.height)
    # By their columns: on a map over north azimuths begin anew in the middle of the picture.
    for (left, low), (right, high) in pairwise(sorted(spots)):
        canvas.dotted([(left * 2.0, low * 4.0), (right * 2.0, high * 4.0)], "accent", 3.0)
    overlay.lines(canvas)
