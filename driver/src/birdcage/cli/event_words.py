"""An event of the station in one line for a person."""

from __future__ import annotations

from birdcage.station.events import Event, Followed, MoveProgress, TranscriptLine
from birdcage.station.narration import words_of


def words_of_event(event: Event) -> str:
    """Return an event in words; the log leaves some of them out, and `birdcage events` none."""
    match event:
        case MoveProgress(position=position):
            here = f"AZ {position.az_deg:.2f} EL {position.el_deg:.2f}"
            return f"under way at {here}, {event.to_go_deg:.2f}° to go, {event.left_s:.1f} s left"
        case Followed(sample=sample):
            return f"following: {sample.error_deg:.3f}° off"
        case TranscriptLine():
            return f"line {event.direction} {event.text}".rstrip()
    return " ".join((words_of(event) or type(event).__name__).split())
