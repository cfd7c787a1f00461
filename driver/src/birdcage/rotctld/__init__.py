"""The dish over TCP, in Hamlib's network protocol for rotators: for Gpredict, SatNOGS, SatDump, Hamlib's own tools.

A face like the others: it asks a `birdcage.station.access.StationAccess` for motions and reads its state. The published
`RotctldServer` is found here, and loaded when asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from birdcage.rotctld.published import RotctldServer

__all__ = ["RotctldServer"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - PEP 562
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from birdcage.rotctld import published

    return getattr(published, name)
