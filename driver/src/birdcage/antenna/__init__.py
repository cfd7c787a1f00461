"""Turns "point there" into safe commands.

The names of the published interface (`docs/reference/published-interface.md`) are loaded when asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna
    from birdcage.antenna.config import AntennaConfig

__all__ = ["AntennaConfig", "BirdcageAntenna"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - PEP 562
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from birdcage.antenna import antenna, config

    return getattr(config if name == "AntennaConfig" else antenna, name)
