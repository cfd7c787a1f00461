"""How the station's events reach the app: one message each, posted from the station's thread."""

from __future__ import annotations

from birdcage.station.events import Event, MoveProgress, PositionRead
from textual.message import Message

_TELEMETRY = (PositionRead, MoveProgress)


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
