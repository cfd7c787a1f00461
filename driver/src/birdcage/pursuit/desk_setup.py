"""What a desk is given once, at its beginning."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from birdcage.base.config import Settings
from birdcage.base.paths import Paths
from birdcage.signal.receiver import ReceiverSource
from birdcage.signal.source import SignalSource
from birdcage.sky.observer import Observer

HOLDER = "tracker"
"""Who has control while the desk follows something."""

ControllerName = Literal["auto", "fast", "velocity", "queued", "modelled", "leapfrog"]


@dataclass(frozen=True, slots=True)
class DeskSetup:
    """Where the satellites are, where the dish stands, and how it is to be used."""

    catalogue: Path
    settings: Callable[[], Settings]
    """Returns those that count now; asked once at the start. `PursuitDesk.apply` brings others later."""
    paths: Paths
    """In its own folder (`Paths.own`) is written what is being followed."""
    observer: Observer | None = None
    """None while no place is set."""
    demo: bool = False
    """Whether all of it is simulated: then nothing that was left unfinished is looked for, or kept."""
    controller: ControllerName | None = None
    """Counts instead of the one in the settings."""
    holder: str = HOLDER
    takes_up: bool = True
    """Whether it offers, or goes on with, what was being followed when the program before it ended."""
    receiver: ReceiverSource | None = None
    """The receiver, where others look at its level, too; None: the desk has it alone."""
    source_of: Callable[[str], SignalSource] | None = None
    """Returns a source of the signal by its id, where others hear it, too; None: the desk has those alone."""
    load: Callable[[], Settings] | None = None
    """Reads the settings again; None where that is not wanted."""


def observer_of(settings: Settings) -> Observer | None:
    """Return where the dish stands by `[place]`; None where none is set."""
    place = settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        return None
    return Observer(place.latitude_deg, place.longitude_deg, place.height_m, name=place.name or "")
