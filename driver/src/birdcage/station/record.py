"""Keeps the faults of a station in the journal."""

from __future__ import annotations

from birdcage.base.journal import Journal, JournalEntry
from birdcage.station.events import Event, FaultRaised
from birdcage.station.station import Station


def keep_faults(station: Station, journal: Journal) -> None:
    """Append every fault that the station raises."""

    def listen(event: Event) -> None:
        if isinstance(event, FaultRaised):
            fault = event.fault
            demo = "DEMO: " if station.state.demo else ""
            journal.append(JournalEntry(event.utc, "dish", fault.reason, f"{demo}{fault.what}. {fault.meaning}"))

    station.subscribe(listen)
