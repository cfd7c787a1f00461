"""The horizon in `birdcage.toml`, and with the saved place that is in use."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.config import Settings
from birdcage.base.errors import ConfigError
from birdcage.base.paths import Paths
from birdcage.base.places import keep_horizon
from birdcage.sky.horizon import HorizonMask

KEY = "place.horizon"


class ConfigHorizon:
    """The `HorizonFile` of a running app. `load` reads the settings anew, with variables and flags over the file."""

    def __init__(self, paths: Paths, settings: Settings, load: Callable[[], Settings]) -> None:
        self._paths, self._load = paths, load
        self.begin = HorizonMask(settings.place.horizon)
        """What the settings held when the app began."""

    def read(self) -> HorizonMask:
        """Return what the settings hold now. ConfigError where they cannot be read, or are not the file's to tell."""
        return HorizonMask(self._settings().place.horizon)

    def write(self, mask: HorizonMask) -> None:
        """Keep another one. ConfigError says why not."""
        keep_horizon(self._paths, self._settings().place, mask.points)

    def _settings(self) -> Settings:
        settings = self._load()
        wrong = next((problem for problem in settings.problems if problem.key in (None, "place", KEY)), None)
        if wrong is not None:
            raise ConfigError(f"The horizon was not saved. {wrong.text}")
        source = settings.sources.get(KEY, "file")
        if source != "file":
            raise ConfigError(f"The {source} sets the horizon and overrides the file. Nothing was saved.")
        return settings
