"""Keeps the faults of a station, and the tasks that ended, in the journal."""

from __future__ import annotations

from birdcage.base.journal import Journal, JournalEntry
from birdcage.station.events import Event, FaultRaised, TaskChanged
from birdcage.station.station import Station
from birdcage.station.task_state import TaskPhase


def keep_journal(station: Station, journal: Journal) -> None:
    """Append every fault that the station raises, and every task that is over."""

    def listen(event: Event) -> None:
        demo = "DEMO: " if station.state.demo else ""
        if isinstance(event, FaultRaised):
            fault = event.fault
            journal.append(JournalEntry(event.utc, "dish", fault.reason, f"{demo}{fault.what}. {fault.meaning}"))
        elif isinstance(event, TaskChanged) and event.task.phase is TaskPhase.OVER:
            task = event.task
            journal.append(JournalEntry(event.utc, "task", task.kind, f"{demo}{task.holder}: {task.why}"))

    station.subscribe(listen, FaultRaised, TaskChanged)
