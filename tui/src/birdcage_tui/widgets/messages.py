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

    def __init__(self, event: Event, of: object = None) -> None:
        """`of` is the dish of which it tells."""
        super().__init__()
        self.event, self.of = event, of

    def can_replace(self, message: Message) -> bool:
        """Return whether this one makes `message` needless."""
        return (
            isinstance(message, StationEvent)
            and message.of is self.of
            and isinstance(self.event, _TELEMETRY)
            and type(message.event) is type(self.event)
        )


class SkyChanged(Message):
    """Another moment of the sky. A newer one replaces one that still waits in the queue."""

    def __init__(self, sky: SkyPicture, of: object = None) -> None:
        """`of` is the dish for which it was worked out."""
        super().__init__()
        self.sky, self.of = sky, of

    def can_replace(self, message: Message) -> bool:
        """Return whether this one makes `message` needless."""
        return isinstance(message, SkyChanged) and message.of is self.of
