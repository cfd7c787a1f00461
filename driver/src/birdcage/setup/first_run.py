"""Whether the setup is what a person needs first; by itself, since a face asks before it paints."""

from __future__ import annotations

from birdcage.base.config import Settings
from birdcage.base.paths import Paths


def is_first_run(settings: Settings, paths: Paths) -> bool:
    """Return whether nothing has been set up here: no birdcage.toml, or neither a setup nor a port in it."""
    return not paths.config_file.exists() or (not settings.setup.begun and settings.dish.port is None)
