"""Keeps in the journal what becomes of a station's dish: its faults, its restarts, its link, settings, ended tasks."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.base.journal import JOURNAL, Journal
from birdcage.base.journal_rows import DishIncident, IncidentKind, JournalEntry, ToldSetting
from birdcage.rotator.feature import LIMITING
from birdcage.station.events import (
    ActivityChanged,
    DishRestarted,
    Event,
    FaultRaised,
    LinkChanged,
    ReadingRead,
    SettingsSaved,
    TaskChanged,
)
from birdcage.station.reply_tally import ReplyTally
from birdcage.station.state import MOVING, Activity, LinkPhase
from birdcage.station.station import Station
from birdcage.station.task_state import TaskPhase
from birdcage.station.wear import dish_key

JUST_S = 0.2
"""A motion that is given up because the dish is out of sight ends in the moment before that is told."""
DOWN = {LinkPhase.SILENT: IncidentKind.SILENT, LinkPhase.LOST: IncidentKind.LOST}


class DishRecord:
    """Hears the station, on its thread, and appends. What is not known of a dish that was not met yet stays empty."""

    def __init__(self, station: Station, journal: Journal, adapter_of: Callable[[str], str]) -> None:
        self._station, self._journal = station, journal
        self._adapter_of, self._adapters = adapter_of, dict[str, str]()
        self._moves, self._moved_at, self._homed = False, -math.inf, list[str]()
        self._problem: str | None = None
        self._was_up = self._is_down = self._lost_moving = False

    @property
    def dish(self) -> str:
        """Under which name its history is kept; empty while no dish is known."""
        state = self._station.state
        return "" if state.dish is None else dish_key(state.dish.name, demo=state.demo)

    @property
    def adapter(self) -> str:
        """By which adapter it is reached: asked of the system once for each port."""
        port = self._station.state.port
        if port not in self._adapters:
            self._adapters[port] = self._adapter_of(port)
        return self._adapters[port]

    def hear(self, event: Event) -> None:
        """Take in an event."""
        if self._journal.problem != self._problem:
            self._problem = self._journal.problem
            self._station.warn(JOURNAL, self._problem or "")
        match event:
            case ActivityChanged():
                moves = event.activity in MOVING
                self._moved_at = event.at if self._moves and not moves else self._moved_at
                self._moves = moves
                if event.activity is Activity.HOMING and event.text:
                    self._homed.append(event.text)
            case FaultRaised(fault=fault):
                self._journal.append(
                    JournalEntry(
                        event.utc, "dish", fault.reason, f"{self._mark}{fault.what}. {fault.meaning}", self.dish,
                        fault.axis, fault.homing, fault.az_deg, fault.el_deg,
                    )
                )  # fmt: skip
            case TaskChanged(task=task) if task.phase is TaskPhase.OVER:
                text = f"{self._mark}{task.holder}: {task.why}"
                self._journal.append(JournalEntry(event.utc, "task", task.kind, text, self.dish))
                self._hear_homing(event)
            case DishRestarted():
                moving = self._is_moving(event.at) or self._lost_moving
                kind = IncidentKind.RESTART if event.was_met else IncidentKind.START
                self._append(event, kind, event.said, moving=moving)
                self._lost_moving = False
            case SettingsSaved(names=names):
                self._append(event, IncidentKind.SAVED, ", ".join(names))
            case LinkChanged():
                self._hear_link(event)
            case ReadingRead() if event.feature.split(".")[0] in LIMITING:
                self._journal.append(ToldSetting(event.utc, self.dish, event.feature, str(event.value)))

    def _hear_homing(self, event: TaskChanged) -> None:
        """Note the axes that were homed, once all that were asked for are, and no fault says otherwise."""
        task, axes, self._homed = event.task, self._homed, []
        if axes and task.done == task.of and self._station.state.fault is None:
            self._append(event, IncidentKind.HOMED, ", ".join(axes))

    def _hear_link(self, event: LinkChanged) -> None:
        """Of a link that was up, note when it goes and when it comes back; what was never up is no loss."""
        link = event.link
        if link.state is LinkPhase.UP:
            if self._was_up and self._is_down:
                self._append(event, IncidentKind.BACK, link.detail)
            self._was_up, self._is_down, self._lost_moving = True, False, False
            _ = self.adapter  # known from now on, also when the port is gone
        elif link.state in DOWN and self._was_up and not self._is_down:
            self._is_down, self._lost_moving = True, self._is_moving(event.at)
            self._append(event, DOWN[link.state], link.detail, moving=self._lost_moving)
        elif link.state is LinkPhase.CLOSED:
            self._was_up = False

    def _is_moving(self, at: float) -> bool:
        return self._moves or at - self._moved_at <= JUST_S

    def _append(self, event: Event, kind: IncidentKind, sentence: str, *, moving: bool = False) -> None:
        self._journal.append(DishIncident(event.utc, self.dish, kind, moving, self.adapter, sentence))

    @property
    def _mark(self) -> str:
        return "DEMO: " if self._station.state.demo else ""


def keep_journal(station: Station, journal: Journal, adapter_of: Callable[[str], str] = str) -> ReplyTally:
    """Append what becomes of the dish. `ReplyTally.write` hands on the last counts at the end.

    `adapter_of` names the adapter behind a port; by default that is the port.
    """
    record = DishRecord(station, journal, adapter_of)
    station.subscribe(
        record.hear, ActivityChanged, FaultRaised, TaskChanged, DishRestarted, LinkChanged, ReadingRead, SettingsSaved
    )  # fmt: skip
    tally = ReplyTally(record, journal, station.clock)
    station.watch(tally.take)
    return tally
