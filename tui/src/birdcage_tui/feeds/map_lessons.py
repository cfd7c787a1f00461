"""What the lessons of a map take from the settings, and where the app keeps what one has taught."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.base.errors import ConfigError

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.skymap.lesson_inputs import LessonInputs
    from birdcage.skymap.sky_map import SkyMap
    from birdcage.skymap.sun_lesson import SunLesson


class MapLessons:
    """Reads files: beside the app's thread, but for `keep_beam` and `why_not_kept`.

    `thrown_away`: all that is kept is gone when the app ends, as with `--demo`.
    """

    def __init__(self, load: Callable[[], Settings], paths: Paths, *, thrown_away: bool = False) -> None:
        self._load, self._paths, self._thrown_away = load, paths, thrown_away

    def inputs(self, sky_map: SkyMap, beam: Beam | None) -> LessonInputs:
        """Return what the lessons of a map go by; `beam` is that of the dish."""
        from birdcage.signal.level_scale import load_scales
        from birdcage.skymap.lesson_inputs import inputs_for

        return inputs_for(sky_map, self._load(), load_scales(self._paths.known_levels).entries, beam)

    def why_not_kept(self, sky_map: SkyMap) -> str:
        """Return why nothing of this map is kept, in a sentence; empty where it may be."""
        from birdcage.skymap.demo_kept import why_demo_not_kept

        return "" if self._thrown_away else why_demo_not_kept(sky_map, self._paths.config_file)

    def keep_beam(self, inputs: LessonInputs, found: SunLesson) -> tuple[str, Settings]:
        """Keep beam and system temperature with the feed; return it in words, and the settings as they are then.

        ConfigError says why nothing was kept.
        """
        from birdcage.skymap.sun_kept import keep_lesson

        feed = inputs.feed
        if feed is None:
            raise ConfigError(f"The feed {inputs.feed_name} is not in birdcage.toml any more. Nothing was kept.")
        words = keep_lesson(self._paths.config_file, inputs.feed_name, feed, found)
        return words, self._load()
