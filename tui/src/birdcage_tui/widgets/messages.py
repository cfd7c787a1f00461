"""What is told to the app: an event of the station (posted from its thread), or a command that the mouse chose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.station.events import Event, MoveProgress, PositionRead
from textual.message import Message

if TYPE_CHECKING:
    from birdcage_tui.shown.sky_picture import SkyPicture

_TELEMETRY = (PositionRead, MoveProgress)


class CommandChosen(Message):
    """A person pressed a command's name, on whatever widget it is written."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name


class StationEvent(Message):
    """An event of the station. A newer position replaces one that still waits in the queue; nothing else does."""

    def __init__(self, event: Event) -> None:
        super().__init__()
        self.event = event

    def can_replace(self, message: Message) -> bool:
        """Return whether this one makes `message` needless."""
        return (
            isinstance(message, StationEvent)
            and isinstance(self.event, _TELEMETRY)
            and type(message.event) is type(self.event)
        )


class SkyChanged(Message):
    """Another moment of the sky. A newer one replaces one that still waits in the queue."""

    def __init__(self, sky: SkyPicture) -> None:
        super().__init__()
        self.sky = sky

    def can_replace(self, message: Message) -> bool:
        """Return whether this one makes `message` needless."""
        return isinstance(message, SkyChanged)
