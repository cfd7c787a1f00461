"""Lessons of a map that were learnt beforehand: what dialogs show of them, without the seconds that they take."""

from __future__ import annotations

from birdcage.antenna.alignment import Alignment
from birdcage.signal.slots_heard import seen_from
from birdcage.skymap.arc_lesson import ArcLesson, SlotMeasured
from birdcage.skymap.sun_lesson import SunLesson
from map_stand_in import OBSERVER

from tests.skymap.made import BEGUN


class Lessons:
    """Stands where the app has `MapLessons`, and for the inputs that it gives."""

    feed_name = "stock"

    def inputs(self, _sky_map, _beam):
        return self

    def why_not_kept(self, _sky_map):
        return ""

    def north(self):
        slots = tuple(
            SlotMeasured(seen, seen.az_deg - 7.0, seen.el_deg, 0.1, 50.0, BEGUN, 0.05, ())
            for seen in seen_from(OBSERVER, "radio")[:4]
        )
        return ArcLesson(Alignment(7.0, 0.0, 0.0, 1.2, -1.6), (0.1, 0.1, 0.2), slots, 0.98, 4.0)

    def sun(self):
        return SunLesson(5.5, 6.4, 0.1, 0.1, 0.2, -0.1, 3.1, 0.1, None, 120, None)
