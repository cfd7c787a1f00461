"""Runs a command line of the user's when something happens that its owner wants to know of while away.

The command gets `BIRDCAGE_EVENT` (a word of `HookEvent`) and `BIRDCAGE_SENTENCE` in its environment, and the event as a
line of JSON on stdin, in the form of `docs/events.md`.
"""

from __future__ import annotations

import logging
import queue
import threading
from enum import StrEnum

from birdcage.base.user_command import UserCommand
from birdcage.station.control_messages import as_line
from birdcage.station.events import (
    ClientIgnored,
    Event,
    FaultRaised,
    HeldChanged,
    LinkChanged,
    NotNowChanged,
    PursuitChanged,
    Recovered,
    TaskChanged,
)
from birdcage.station.json_form import to_json
from birdcage.station.narration import words_of
from birdcage.station.pursuit_state import Phase
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station
from birdcage.station.task_state import TaskPhase

MOST_AT_ONCE = 4
"""So many commands run at a time; events that come meanwhile wait."""
MOST_WAITING = 50
"""So many wait; the oldest is then left out, and said to be."""
LOOK_S = 0.2
"""How often it is looked whether a command has ended."""
SUBJECT = "on_event"
"""Under which the station warns that the command does not work."""
TOLD_OTHERWISE = ("drive", "homing", "park", "pursuit", "recovery", "shelter")
"""Tasks whose end is no event here: a person stands by, or it is told as a pass."""

KINDS = (
    ClientIgnored, FaultRaised, HeldChanged, LinkChanged, NotNowChanged, PursuitChanged, Recovered, TaskChanged,
)  # fmt: skip
log = logging.getLogger(__name__)


class HookEvent(StrEnum):
    """What the command is told as `BIRDCAGE_EVENT`."""

    FAULT = "fault"
    LINK_LOST = "link_lost"
    """The dish no longer answers, or its port is gone."""
    LINK_BACK = "link_back"
    HELD = "held"
    RELEASED = "released"
    CLIENT_IGNORED = "client_ignored"
    """The wishes of a network client are not carried out."""
    RECOVERED = "recovered"
    """The dish had restarted, and was homed again (`station.after_reboot = home`)."""
    NOT_NOW = "not_now"
    """The owner's command says that the dish may not move unattended, or that it may again."""
    PASS_ENDED = "pass_ended"  # noqa: S105 - the pass of a satellite
    TASK_ENDED = "task_ended"
    """A scan or map is over."""


class EventHooks:
    """Hears a station from its making on. Commands are started on a thread of their own."""

    def __init__(self, station: Station, command: str, deadline_s: float) -> None:
        self._station, self._command, self._deadline_s = station, command, deadline_s
        self._link_lost = self._held = False
        self._told: queue.SimpleQueue[tuple[HookEvent, Event] | None] = queue.SimpleQueue()
        self._running: list[UserCommand] = []
        self._thread = threading.Thread(target=self._run, name="event hooks", daemon=True)
        self._thread.start()
        self._unsubscribe = station.subscribe(self._hear, *KINDS)

    def close(self, timeout_s: float) -> None:
        """Start what waits, and ask what runs to end; wait for that no longer than `timeout_s`."""
        self._unsubscribe()
        self._told.put(None)
        self._thread.join(timeout_s)

    def _hear(self, event: Event) -> None:
        """On the station's thread: nothing here waits for a command."""
        kind = self._kind_of(event)
        if kind is not None:
            self._told.put((kind, event))

    def _kind_of(self, event: Event) -> HookEvent | None:
        match event:
            case FaultRaised():
                return HookEvent.FAULT
            case LinkChanged(link=link) if link.state in (LinkPhase.UP, LinkPhase.LOST, LinkPhase.SILENT):
                before, self._link_lost = self._link_lost, link.state is not LinkPhase.UP
                if before != self._link_lost:
                    return HookEvent.LINK_LOST if self._link_lost else HookEvent.LINK_BACK
            case HeldChanged(held=held):
                was_held, self._held = self._held, held is not None
                if was_held != self._held:  # else it only says who would move it next
                    return HookEvent.HELD if self._held else HookEvent.RELEASED
            case ClientIgnored():
                return HookEvent.CLIENT_IGNORED
            case Recovered():
                return HookEvent.RECOVERED
            case NotNowChanged():
                return HookEvent.NOT_NOW
            case PursuitChanged(pursuit=pursuit) if pursuit.phase is Phase.OVER:
                return HookEvent.PASS_ENDED
            case TaskChanged(task=task) if task.phase is TaskPhase.OVER and task.kind not in TOLD_OTHERWISE:
                return HookEvent.TASK_ENDED
        return None

    def _run(self) -> None:
        closing = False
        while not closing or not self._told.empty():
            try:
                told = self._told.get(timeout=LOOK_S if self._running else None)
            except queue.Empty:
                self._look()
                continue
            if told is None:
                closing = True
            elif self._told.qsize() >= MOST_WAITING:
                self._complain(f"{MOST_WAITING} events wait for {self._command}, so {told[0]} is left out.")
            else:
                self._make_room(closing=closing)
                self._start(*told)
        for each in self._running:
            each.end()
            each.leave()

    def _make_room(self, *, closing: bool) -> None:
        while len(self._running) >= MOST_AT_ONCE and not closing:
            self._running[0].wait(LOOK_S)
            self._look()

    def _start(self, kind: HookEvent, event: Event) -> None:
        told = {"BIRDCAGE_EVENT": kind.value, "BIRDCAGE_SENTENCE": words_of(event)}
        line = as_line(to_json(event)).decode()
        run = UserCommand(self._command, told, line, self._say, deadline_s=self._deadline_s)
        self._running.append(run)

    def _look(self) -> None:
        """See what has ended, and how."""
        for run in [each for each in self._running if each.over]:
            self._running.remove(run)
            if run.status == 0:
                self._station.warn(SUBJECT, "")
            else:
                how = "could not be started" if run.status is None else f"ended with status {run.status}"
                self._complain(f"hooks.on_event: {self._command} {how}.")

    def _say(self, text: str) -> None:
        log.info("on_event: %s", text)

    def _complain(self, sentence: str) -> None:
        log.warning("%s", sentence)
        self._station.warn(SUBJECT, sentence)
