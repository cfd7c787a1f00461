"""Replay of a recording: first which one, then a screen of its own under a row 1 that stays live."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar, cast

from birdcage.base.errors import BirdcageError
from birdcage.signal.recordings import Recording, list_recordings
from birdcage.signal.replay import Tape, TapeWindow, open_tape, read_window
from textual import events
from textual.app import ComposeResult
from textual.containers import Container
from textual.timer import Timer

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.passes.time_text import moment_of
from birdcage_tui.shown.view import View
from birdcage_tui.signal.replay_deck import ReplayDeck
from birdcage_tui.signal.replay_panes import (
    ReplayBanner,
    ReplayKeys,
    ReplayLevelPane,
    ReplayPane,
    ReplayStripPane,
    ReplayWholePane,
)
from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values
from birdcage_tui.widgets.status import BadDayRow, TopRow

if TYPE_CHECKING:
    from birdcage_tui.widgets.page import Page

Found = TypeVar("Found")
FRAME_S = 0.1
"""Between two frames while it plays."""
STEP_S, LEAP_S = 10.0, 60.0
LOW = 20
"""Rows below which there is no room for three frames."""
EXAMPLES = "12:30:10, +2m, -30s or 2026-11-22 04:10 (UTC)"


def recordings_question(recordings: Sequence[Recording]) -> ChoiceScreen:
    """Return the list of them, the newest first."""
    words = "The dish stays live beside a replay: row 1 shows it, and Space stops it."
    return ChoiceScreen("Replay a recording", [_row(each) for each in recordings if each.readings], words)


def _row(recording: Recording) -> ChoiceRow:
    length_s = 0.0 if recording.ended is None else (recording.ended - recording.begun).total_seconds()
    minutes, seconds = divmod(round(length_s), 60)
    demo = "DEMO  " if recording.demo else ""
    first = f"{recording.number:>3}  {recording.begun:%Y-%m-%d %H:%M}Z  {minutes}:{seconds:02d} long  {demo}"
    span = "" if recording.low is None or recording.high is None else f", {recording.low:.4g} to {recording.high:.4g}"
    targets = f", {', '.join(recording.targets)}" if recording.targets else ""
    second = f"     {recording.source}, {recording.readings:,} readings{span} {recording.unit}{targets}"
    return ChoiceRow(str(recording.number), first.rstrip(), second)


@dataclass(frozen=True, slots=True)
class _Failed:
    """Why something could not be read."""

    words: str


class ReplayScreen(Dialog[None]):
    """Plays one recording. Only its own keys hold here, and none of them reaches the dish; Space stops the dish."""

    DEFAULT_CSS = """
    ReplayScreen { layout: vertical; background: $background; }
    ReplayScreen #replay { width: 100%; height: 1fr; background: $background; }
    ReplayScreen ReplayBanner, ReplayScreen ReplayKeys { height: 1; }
    ReplayScreen ReplayLevelPane, ReplayScreen ReplayStripPane, ReplayScreen ReplayWholePane {
        border: round $warning; border-title-color: $warning; border-title-style: none; width: 1fr; }
    ReplayScreen ReplayLevelPane { height: 6; }
    ReplayScreen ReplayStripPane { height: 2fr; }
    ReplayScreen ReplayWholePane { height: 1fr; min-height: 5; }
    ReplayScreen.-low ReplayLevelPane, ReplayScreen.-low ReplayStripPane { border: none; }
    ReplayScreen.-low ReplayLevelPane { height: 4; }
    ReplayScreen.-low ReplayWholePane { display: none; }
    """
    BINDINGS = [  # noqa: RUF012
        ("l,q,escape", "leave", "live"), ("p", "pause", "pause"), ("plus,equals_sign", "speed(1)", "faster"),
        ("minus", "speed(-1)", "slower"), ("left", f"skip(-{STEP_S:g})", "back"), ("right", f"skip({STEP_S:g})", "on"),
        ("pageup", f"skip(-{LEAP_S:g})", "back"), ("pagedown", f"skip({LEAP_S:g})", "on"), ("home", "edge(0)", "begin"),
        ("end", "edge(1)", "end"), ("g", "ask_time", "time"), ("v", "turn", "axis"),
        ("enter", "release", "release"),
    ]  # fmt: skip

    def __init__(self, path: Path, tape: Tape) -> None:
        super().__init__()
        self._path, self.deck = path, ReplayDeck(tape)
        self._timer: Timer | None = None
        self._reads = False

    def compose(self) -> ComposeResult:
        """Rows that are live, then the past."""
        yield TopRow()
        with Container(id="replay"):
            yield BadDayRow()
            yield ReplayBanner(self.deck)
            yield ReplayLevelPane(self.deck)
            yield ReplayStripPane(self.deck)
            yield ReplayWholePane(self.deck)
            yield ReplayKeys(self.deck)

    def on_resize(self, event: events.Resize) -> None:
        """Leave frames and the picture of the whole away where there are few rows."""
        self.set_class(event.size.height < LOW, "-low")

    def on_mount(self) -> None:
        """Read, and play."""
        super().on_mount()
        self._timer = self.set_interval(FRAME_S, self._tick)
        self.call_after_refresh(self._tick)

    def show(self, view: View) -> None:
        """Draw the live row, and the moment that it has come to."""
        row = self.query_one_optional(BadDayRow)
        if row is None:
            return  # not composed yet
        row.show(view)
        self.deck.play(view.now)
        wanted = self.deck.wanted
        if wanted is not None and not self._reads:
            self._reads = True
            self.run_worker(partial(self._read, *wanted), thread=True, group="replay")
        for pane in self.query(ReplayPane):
            pane.show(view)

    def _tick(self) -> None:
        """Draw while it plays, or waits for the disk: at rest nothing changes but what is live."""
        if self._reads or not (self.deck.paused or self.deck.is_over):
            self.show(cast(AppHost, self.app).view())

    def _read(self, begins: datetime, ends: datetime) -> None:
        """Read on the worker's thread."""
        found: TapeWindow | _Failed
        try:
            found = read_window(self._path, self.deck.tape, begins, ends)
        except BirdcageError as error:
            found = _Failed(str(error))
        self.app.call_from_thread(self._take, found)

    def _take(self, found: TapeWindow | _Failed) -> None:
        self._reads = False
        if isinstance(found, _Failed):
            cast(AppHost, self.app).say(found.words)
            self.dismiss(None)
            return
        self.deck.take(found)
        self.show(cast(AppHost, self.app).view())

    def _shown(self) -> None:
        self.show(cast(AppHost, self.app).view())

    def action_pause(self) -> None:
        """Stand still, or go on."""
        self.deck.pause()
        self._shown()

    def action_speed(self, steps: int) -> None:
        """Go faster or slower."""
        self.deck.change_speed(steps)
        self._shown()

    def action_skip(self, seconds: float) -> None:
        """Jump by so many seconds."""
        self.deck.jump(self.deck.at + timedelta(seconds=seconds))
        self._shown()

    def action_edge(self, end: int) -> None:
        """Jump to the beginning or the end."""
        self.deck.jump(self.deck.tape.ends if end else self.deck.tape.begins)
        self._shown()

    def action_turn(self) -> None:
        """Show the readings against another axis."""
        self.query_one(ReplayStripPane).turn()
        self._shown()

    def action_release(self) -> None:
        """Release a dish that is held, as row 2 says."""
        cast(AppHost, self.app).action_command("release")

    def action_ask_time(self) -> None:
        """Ask for a moment."""
        tape, at = self.deck.tape, self.deck.at

        def check(values: Values) -> str:
            try:
                moment_of(values[0], tape.begins)
            except ValueError as wrong:
                return str(wrong)
            return ""

        words = f"From {tape.begins:%Y-%m-%d %H:%M:%S}Z to {tape.ends:%H:%M:%S}Z. Shown now is {at:%H:%M:%S}Z."
        row = FieldRow("UTC", "", EXAMPLES)
        self.app.push_screen(FieldsScreen("Jump to a time", words, (row,), check, enter="Enter jumps"), self._jump)

    def _jump(self, values: Values | None) -> None:
        if values is None:
            return
        text = values[0].strip()
        since = self.deck.at if text[:1] in "+-" else self.deck.tape.begins
        self.deck.jump(moment_of(text, since))
        self._shown()


class ReplayDesk:
    """Asks which recording, and replays it. The disk is read by workers: the app's thread never waits for it."""

    def __init__(self, page: Page, path: Path) -> None:
        self._page, self._path = page, path

    def open(self) -> None:
        """List what there is."""
        self._in_worker(partial(list_recordings, self._path), self._choose)

    def _choose(self, recordings: Sequence[Recording]) -> None:
        if any(each.readings for each in recordings):
            self._page.app.push_screen(recordings_question(recordings), self._chosen)
        else:
            self._page.dish.say("Nothing recorded yet. r records the signal.")

    def _chosen(self, number: str | None) -> None:
        if number is not None:
            self._page.dish.say(f"Reading recording {number} …")
            self._in_worker(partial(open_tape, self._path, int(number)), self._play)

    def _play(self, tape: Tape) -> None:
        self._page.dish.say(f"Replaying recording {tape.recording.number}.")
        self._page.app.push_screen(ReplayScreen(self._path, tape))

    def _in_worker(self, read: Callable[[], Found], then: Callable[[Found], None]) -> None:
        """Read on a thread of its own, then go on with what was found; say what went wrong."""
        app, dish = self._page.app, self._page.dish

        def have(found: Found) -> None:
            if self._page.is_attached:
                then(found)
            else:  # another dish is shown
                dish.say("The recordings are read. R on F3 lists them.")

        def work() -> None:
            try:
                found = read()
            except BirdcageError as error:
                app.call_from_thread(dish.say, str(error))
            else:
                app.call_from_thread(have, found)

        app.run_worker(work, thread=True, group="replay")
