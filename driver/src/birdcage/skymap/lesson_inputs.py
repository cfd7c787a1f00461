"""What the lessons of a map go by besides the map: place, beam, scale of the source, feed. And the lessons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.signal.level_scale import LevelScale, find_scale
from birdcage.sky.observer import Observer

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import FeedProfile, Settings
    from birdcage.skymap.arc_lesson import ArcLesson
    from birdcage.skymap.horizon_lesson import HorizonProposal
    from birdcage.skymap.sky_map import SkyMap
    from birdcage.skymap.sun_lesson import SunLesson


@dataclass(frozen=True, slots=True)
class LessonInputs:
    """A map, and what is known of the dish and place that it was made with. Each lesson raises LessonRefused."""

    sky_map: SkyMap
    settings: Settings
    beam: Beam | None
    """For a map that tells no beam of its own."""
    observer: Observer | None
    """The active place, for a map that tells none; None where none is set."""
    scale: LevelScale | None
    """Decibels of its source by two known levels; None where none are kept."""
    feed_name: str
    """That it was made with; the active one where it does not tell."""

    @property
    def feed(self) -> FeedProfile | None:
        """That feed's settings; None where they are gone."""
        return self.settings.feeds.get(self.feed_name)

    @property
    def is_place_known(self) -> bool:
        """Whether it is known where the map was made."""
        return self.observer is not None or self.sky_map.place() is not None

    def horizon(self) -> HorizonProposal:
        """Return the line of trees and roofs."""
        from birdcage.skymap.horizon_lesson import teach_horizon
        from birdcage.skymap.known_sources import observer_of, sources_over

        sources: Sequence[tuple[float, float]] = ()
        if self.is_place_known:
            place = observer_of(self.sky_map, self.observer)
            sources = sources_over(self.sky_map, place, self.settings.tracking.refraction)
        return teach_horizon(self.sky_map, sources, self.beam, self.scale)

    def north(self, within_deg: float = 180.0) -> ArcLesson:
        """Return north and tilt; it takes some seconds."""
        from birdcage.skymap.arc_lesson import teach_north
        from birdcage.skymap.known_sources import arc_over, observer_of

        slots = arc_over(observer_of(self.sky_map, self.observer), self.settings.tracking.refraction)
        return teach_north(self.sky_map, slots, self.beam, self.scale, within_deg)

    def sun(self) -> SunLesson:
        """Return beam, system temperature and G/T."""
        from birdcage.skymap.sun_lesson import teach_sun

        feed = self.feed
        return teach_sun(
            self.sky_map, self.scale, None if feed is None else feed.middle_hz, self.observer,
            self.settings.tracking.refraction, self.beam,
        )  # fmt: skip


def inputs_for(sky_map: SkyMap, settings: Settings, scales: Sequence[LevelScale], beam: Beam | None) -> LessonInputs:
    """Return what the lessons of a map go by."""
    place, observer = settings.place, None
    if place.latitude_deg is not None and place.longitude_deg is not None:
        observer = Observer(place.latitude_deg, place.longitude_deg, place.height_m)
    feed_name = str(sky_map.about.get("feed") or settings.feed.active)
    scale = find_scale(scales, sky_map.source, feed_name)
    return LessonInputs(sky_map, settings, beam, observer, scale, feed_name)
