"""A source of the signal, as it is offered to a person."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.signal.source import SignalFacts


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """One source, as it is offered."""

    facts: SignalFacts
    chosen: bool
    owner: str
    """For which target it is read, or `monitor`; empty while it is free."""
    trouble: str
    """Why it tells nothing now; empty also where that was not tried."""
