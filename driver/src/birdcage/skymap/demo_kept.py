"""Whether what a simulated sky taught may go into the settings of a dish."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.skymap.sky_map import SkyMap

NOT_KEPT = "DEMO map: nothing is kept, as birdcage.toml has no simulated port."


def why_demo_not_kept(sky_map: SkyMap, config_file: Path) -> str:
    """Return why nothing of this map is kept beside that file, in a sentence; empty where it may be.

    What a map of a simulated sky teaches is false for every other dish. The file alone counts: a port that an option
    or the environment names for once leaves the settings those of another dish.
    """
    from birdcage.base.config import load

    if not sky_map.demo or (load(config_file, environ={}).dish.port or "").startswith("sim:"):
        return ""
    return NOT_KEPT
