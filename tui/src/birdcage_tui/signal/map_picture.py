"""The parts of a map's picture that last from frame to frame: levels, satellites, horizon and the Sun's path."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.plan import MapFrame

from birdcage_tui.shown.map_book import MapShown, map_task
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_marks import NamedSpot, draw_horizon, draw_names, draw_sun_path, slots_over, sun_path
from birdcage_tui.signal.map_overlay import MapOverlay
from birdcage_tui.signal.map_raster import raster
from birdcage_tui.signal.map_surface import MapSurface

SUN_KEPT_S = 1800.0
"""So long the Sun's path of a day is good: it moves by some hundredths of a degree."""


class MapPicture:
    """Makes each part anew only where something that it shows has changed."""

    def __init__(self) -> None:
        self._made: tuple[MapShown, MapChart, bool, str] | None = None
        self._levels: MapSurface | None = None
        self._marked: tuple[MapChart, SitePlace | None, HorizonMask, float, float] | None = None
        self._marks = MapOverlay(0, 0)
        self._slots: tuple[SitePlace | None, tuple[NamedSpot, ...]] = (None, ())
        self._path: tuple[SitePlace | None, float, Sequence[tuple[float, float]]] = (None, 0.0, ())

    def surface(
        self, shown: MapShown, chart: MapChart, view: View, place: SitePlace | None, *, plain: bool
    ) -> MapSurface:  # fmt: skip
        """Return a copy that may be drawn on: levels, horizon, the Sun's path, satellites."""
        now = (shown, chart, plain, view.settings.glyphs)
        if self._levels is None or self._made != now:
            span = (0.0, 1.0) if shown.span is None else shown.span
            levels = raster(shown.plan, shown.grid, (chart.width, 2 * chart.height), span)
            self._made = now
            self._levels = MapSurface(levels, plain=plain, ascii_only=view.settings.glyphs == "ascii")
        surface = self._levels.copy()
        surface.lay(self._marks_for(shown, chart, view, place))
        return surface

    def _marks_for(self, shown: MapShown, chart: MapChart, view: View, place: SitePlace | None) -> MapOverlay:
        when, beam_deg = _when(shown, view), _beam_deg(shown, view)
        mask = HorizonMask() if shown.is_elsewhere(view.settings.place) else view.horizon.mask
        now = (chart, place, mask, beam_deg, when.timestamp() // SUN_KEPT_S)
        if self._marked != now:
            self._marked, self._marks = now, MapOverlay(chart.width, chart.height)
            draw_horizon(self._marks, chart, mask)
            if chart.plan.frame is MapFrame.TARGET:
                target = NamedSpot(str(shown.sky.about.get("target") or ""), 0.0, 0.0)
                draw_names(self._marks, chart, [target], beam_deg)
            elif place is not None:
                draw_sun_path(self._marks, chart, self._sun_path(place, when))
                draw_names(self._marks, chart, self._slots_over(place), beam_deg)
        return self._marks

    def _sun_path(self, place: SitePlace, when: datetime) -> Sequence[tuple[float, float]]:
        bucket = when.timestamp() // SUN_KEPT_S
        if self._path[:2] != (place, bucket):
            self._path = (place, bucket, sun_path(place, when))
        return self._path[2]

    def _slots_over(self, place: SitePlace) -> tuple[NamedSpot, ...]:
        if self._slots[0] != place:
            self._slots = (place, slots_over(place))
        return self._slots[1]

    def slot_places(self, place: SitePlace | None) -> tuple[tuple[str, float, float], ...]:
        """Return name and direction of every satellite of the arc; none without a place."""
        if place is None:
            return ()
        return tuple((each.label, each.az_deg, each.el_deg) for each in self._slots_over(place))

    @staticmethod
    def sun(place: SitePlace, when: datetime) -> tuple[float, float]:
        """Return where the Sun stands: azimuth and elevation."""
        from birdcage.sky.sun import sun

        return sun(when, place.latitude_deg, place.longitude_deg)


def _beam_deg(shown: MapShown, view: View) -> float:
    """Return how high the beam is that heard the map; of the dish's own where the map does not say."""
    told = shown.sky.about.get("beam_el_deg")
    if isinstance(told, int | float):
        return float(told)
    return ASSUMED_WIDTH_DEG if view.state.beam is None else view.state.beam.el_deg


def _when(shown: MapShown, view: View) -> datetime:
    """Return the moment whose day's Sun is shown: now while the map is made, else when it was heard last."""
    if map_task(view.state.tasks, shown.key) is not None:
        return view.utc
    return shown.sky.ended or next((each.utc for each in reversed(shown.sky.samples) if each.utc), None) or view.utc
