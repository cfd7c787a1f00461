"""What an event tells a person at once, in one sentence."""

from __future__ import annotations

from birdcage.signal.step_track_task import StepTrackTask
from birdcage.station.events import End, Event, MoveEnded, TaskChanged
from birdcage.station.state import StationState
from birdcage.station.task_state import TaskPhase, TaskState

from birdcage_tui.shown.pursuit import STEERED
from birdcage_tui.shown.state_words import ended_text
from birdcage_tui.shown.view import YOU

FINDING = {
    "peak": "Finding the peak", "acquire": "Searching", "sweep": "Sweeping", "firmware sweep": "Sweeping",
    "on-off": "On-off", "drift": "Drift scan", "map": "Mapping the sky",
    "step-track": "Step-track",
}  # fmt: skip
"""What tasks do that go by the signal, by their kind."""


def finding_now(state: StationState) -> TaskState | None:
    """Return the task that leads the dish by the signal; None if there is none."""
    return next((task for task in state.tasks if task.kind in FINDING), None)


def finding_words(task: TaskState) -> str:
    """Say how far such a task is."""
    if task.kind == StepTrackTask.kind:
        peaks = task.found.get("peaks", 0)
        return f"{FINDING[task.kind]}: {peaks} peak{'' if peaks == 1 else 's'} so far"
    return f"{FINDING[task.kind]}: {task.done or 0} of {task.of} heard"


def event_words(event: Event, state: StationState) -> str:
    """Return the sentence; empty for what is no result of a command."""
    if isinstance(event, MoveEnded):
        return "" if _is_on_its_way(event, state) else ended_text(event)
    if isinstance(event, TaskChanged) and event.task.kind in FINDING and event.task.holder == YOU:
        return event.task.why if event.task.phase is TaskPhase.OVER else ""
    return ""


def _is_on_its_way(event: MoveEnded, state: StationState) -> bool:
    """Return whether another motion follows, or a pursuit or a task arrived on its way."""
    steered = state.pursuit is not None and state.pursuit.phase in STEERED
    leads = steered or finding_now(state) is not None
    return event.end is End.SUPERSEDED or (event.end is End.ARRIVED and leads)
