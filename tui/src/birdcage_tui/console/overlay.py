"""The console: it lies over the lower two thirds of any page, which goes on painting above it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, cast

from birdcage.base.errors import LeaseDenied
from textual import events, on
from textual.app import ComposeResult
from textual.containers import Container, Horizontal, Vertical
from textual.timer import Timer
from textual.widget import Widget
from textual.widgets import Input

from birdcage_tui.console import saying
from birdcage_tui.console.asking import Asking
from birdcage_tui.console.console_host import ConsoleHost
from birdcage_tui.console.entry import ConsoleInput, FindInput, Purpose
from birdcage_tui.console.frame import HeadLine, HintLine, KeysLine, PromptCell
from birdcage_tui.console.history import History
from birdcage_tui.console.lines_sent import LinesSent
from birdcage_tui.console.log import LogView
from birdcage_tui.console.save import save
from birdcage_tui.console.scrollback import Scrollback
from birdcage_tui.console.wire_log import WireLog
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.stop_words import esc_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import QuestionScreen

FLUSH_S = 0.1
"""Between two looks at the wire: so many lines a second as there may be, ten pictures of them."""
HOW = "i or Enter: type a line for the dish. Sending it takes control."
TYPE = "Enter sends, Tab completes, Esc back to the log. Ctrl+C stops the dish."
MOVING = "Enter sends, Tab completes. Esc or Ctrl+C stops the dish, which may move."
TAKE = "Enter copies it to the line and sends nothing. ^R: an older one"
PART = "Type a part of a line that you have sent"
NONE = "No sent line contains this."
KEEP = "Enter accepts. Then n and N step through the matches"


class DishLog(NamedTuple):
    """What the console has seen of one dish. While another one is shown the tap keeps what passes."""

    wire: WireLog
    back: Scrollback


class ConsoleOverlay(Container):
    """Watches the wire; talks to the dish once a line was entered."""

    def __init__(self, shell: ConsoleHost, log: DishLog | None = None) -> None:
        """Go on with this log of the dish that is shown; without, begin one."""
        super().__init__(id="console")
        self.dish_log = log or DishLog(WireLog(shell.tap, shell.station), Scrollback())
        self._shell, self._tap, self._wire = shell, shell.tap, self.dish_log.wire
        self._pane, self._entry, self._finder = (
            LogView(back=self.dish_log.back),
            ConsoleInput(self.do),
            FindInput(self.do),
        )
        self._head, self._hinted, self._prompt, self._keys = HeadLine(), HintLine(), PromptCell(), KeysLine()
        self._sent = LinesSent(shell.station.submit, shell.soon, self._failed)
        history = History(shell.settings.history_file)
        self._asking = Asking(shell.station, self._sent, history, self._ask, self._remark)
        self._recalled = 0
        self._listed: str | None = None
        """The menu whose commands the dish was asked for last."""
        self._flushes: Timer | None = None

    @property
    def scope(self) -> str:
        """Its commands' `where`."""
        return "console"

    def compose(self) -> ComposeResult:
        """The edge, the log, the hint, the line, the edge."""
        yield self._head
        with Vertical(id="console-body"):
            yield self._pane
            yield self._hinted
            with Horizontal(id="console-entry"):
                yield self._prompt
                yield self._entry
                yield self._finder
        yield self._keys

    def on_mount(self) -> None:
        """Begin to look at the wire."""
        self._flushes = self.set_interval(FLUSH_S, self._flush)
        self._tap.begin()
        if self._tap.problem:
            self._remark(self._tap.problem)

    # Open and closed.

    @property
    def is_open(self) -> bool:
        """Whether it is seen."""
        return bool(self.display)

    def open(self) -> None:
        """Show it; the log has the focus, so that Space stops the dish."""
        self.display = True
        if self._flushes is not None:
            self._flushes.resume()
        self.screen.set_focus(self._pane)

    def close(self) -> None:
        """Hide it, and give control back."""
        if saying.talking(self._shell.view()) or self._sent.under_way:
            self._sent.leave(self._now)
        self._end_find(self._pane)
        self._asking.drop()
        self.display = False
        if self._flushes is not None:
            self._flushes.pause()

    @property
    def typing(self) -> bool:
        """Whether the line for the dish has the focus."""
        return self.is_open and self._entry.has_focus

    def on_descendant_focus(self) -> None:
        """What is polled depends on whether somebody types."""
        self._shell.typing_changed()

    def on_descendant_blur(self) -> None:
        """Polling goes on as before."""
        self._shell.typing_changed()

    # What is seen.

    @property
    def _now(self) -> float:
        return self._shell.session.clock.monotonic()

    def show(self, view: View) -> None:
        """Draw everything. Where nothing has the focus (a dialog gave it back to none), the log takes it."""
        if self.size.area and self.screen.focused is None:
            self.screen.set_focus(self._pane)
        if not view.link_up:
            self._wire.forget_prompt()
        lines = self._wire.take(view.utc)
        self._pane.add(lines)
        if any(line.direction == "<" for line in lines) and self._sent.under_way:
            self._sent.heard(view.now)
        self._asking.changed(self._entry.value, view)
        self._dress(view)
        for pane in (self._head, self._pane, self._hinted, self._prompt, self._keys):
            pane.show(view)

    def _flush(self) -> None:
        if self._tap.waiting and self.is_open:
            self.show(self._shell.view())

    def _dress(self, view: View) -> None:
        """Set what the rows say."""
        self._head.mode = saying.mode_words(view, view.now - self._sent.last)
        self._head.right, self._head.right_command = self._figures()
        searching, prompt = self._finder.display, self._prompt_words(view)
        self._prompt.words = f"{self._finder.purpose.value}:" if searching else prompt
        ink = saying.ink_of(self._asking.verdict) if self._asking.warns(view) else ""
        self._prompt.ink = "bar-warn" if ink and not searching else "bar"
        self._entry.set_class(ink == "warn-row", "-warn")
        self._entry.set_class(ink == "fault-row", "-fault")
        self._hinted.says = self._hint(view)
        keys = self._keys
        keys.shown = keys.FIND if searching else keys.LINE if self._entry.has_focus else keys.LOG
        self._head.lit = self._keys.lit = self.has_focus_within

    def _prompt_words(self, view: View) -> str:
        return saying.prompt_words(view, self._wire.prompt, has_prompt=self._shell.station.has_prompt)

    def _hint(self, view: View) -> tuple[tuple[str, str], ...]:
        leave = esc_text(view, closes="leaves", other="Backspace leaves")
        if self._finder.display and self._finder.purpose is Purpose.HISTORY:
            found = self._asking.history.find(self._finder.value, self._recalled)
            if found:
                return (found, "strong"), (f"{TAKE}, {leave}.", "dim")
            return ((NONE if self._finder.value else f"{PART}, {leave}.", "dim"),)
        if self._finder.display:
            return ((f"{KEEP}, {leave}.", "dim"),)
        how = HOW if not self._entry.has_focus else MOVING if view.may_move else TYPE
        return self._asking.hint(view) or ((how, "dim"),)

    def _figures(self) -> tuple[tuple[str, str], str]:
        """Return what stands at the right of the upper edge, and what a click there does."""
        log, tap = self._pane, self._tap
        if log.needle:
            number = f"{log.match_number} of {len(log.matches)}" if log.matches else "no match"
            return (f'"{log.needle}" {number}  n N', "target-strong"), "console-next"
        if not log.following:
            return (f"▼ {log.fresh} new, End follows", "warn-strong"), "console-end"
        if tap.since is None:
            return ("", "dim"), ""
        counted = f"in {saying.bytes_text(tap.bytes_in)}  out {saying.bytes_text(tap.bytes_out)}"
        return (f"{counted}  since {tap.since:%H:%M}", "dim"), ""

    # Commands.

    def do(self, command: str) -> bool:
        """Carry out a command of the console."""
        log, line = self._pane, self._entry
        deeds: dict[str, Callable[[], object]] = {
            "console-type": self._type,
            "console-find": lambda: self._open_find(Purpose.LOG),
            "console-next": lambda: log.step_match(1),
            "console-previous": lambda: log.step_match(-1),
            "console-stamps": lambda: log.write_as(stamps=log.back.stamps.next),
            "console-hex": lambda: log.write_as(as_hex=not log.back.as_hex),
            "console-polling": lambda: log.write_as(folded=not log.back.folded),
            "console-save": self._save,
            "console-clear": log.clear,
            "console-up": lambda: log.move(-1),
            "console-down": lambda: log.move(1),
            "console-page-up": lambda: log.turn(-1),
            "console-page-down": lambda: log.turn(1),
            "console-home": log.go_home,
            "console-end": log.go_end,
            "console-complete": self._complete,
            "console-older": lambda: self._put(self._asking.history.older(line.value)),
            "console-newer": lambda: self._put(self._asking.history.newer(line.value)),
            "console-recall": self._recall,
            "console-end-line": lambda: self._sent.end_line(self._now),
        }
        deed = deeds.get(command)
        if deed is None:
            return False
        deed()
        self.show(self._shell.view())
        return True

    def _type(self) -> None:
        self._end_find(self._entry)

    def _put(self, text: str) -> None:
        self._entry.value = text
        self._entry.cursor_position = len(text)
        self._type()

    def _complete(self) -> None:
        view = self._shell.view()
        if not self._entry.value.strip() and saying.talking(view) and view.state.menu != self._listed:
            self._listed = view.state.menu
            self._sent.ask_list(lambda found: self._remark(saying.list_words(found)))
        else:
            self._put(self._asking.complete(view))

    def _save(self) -> None:
        folder, view = self._shell.settings.logs_folder, self._shell.view()
        if folder is None:
            self._remark("Not saved: this app has no log folder.")
            return
        title = f"birdcage console, port {view.state.port}" + (", DEMO (simulated dish)" if view.state.demo else "")
        try:
            path = save(self._pane.back.lines, folder, view.utc, title)
        except OSError as error:
            self._remark(f"Not saved in {folder}: {error.strerror or error}.")
            return
        words = f"{len(self._pane.back.lines)} lines saved: {path}"
        self._remark(words)
        cast(AppHost, self.app).say(words)  # in the log it would soon scroll away

    def _remark(self, words: str) -> None:
        self._wire.remark(words, self._shell.session.clock.utc())

    # The line.

    @on(Input.Changed, "ConsoleInput")
    def _changed(self) -> None:
        self.show(self._shell.view())

    @on(Input.Submitted, "ConsoleInput")
    def _entered(self, event: Input.Submitted) -> None:
        event.stop()
        view = self._shell.view()
        self._asking.changed(event.value, view)
        self._asking.enter(view, self._went_out)
        self.show(self._shell.view())

    def _went_out(self) -> None:
        """The line is on its way: make room for the next one, and show what comes back."""
        self._put("")
        self._pane.go_end()

    def _ask(self, title: str, words: str, yes: str, then: Callable[[], None]) -> None:
        def answered(answer: bool | None) -> None:
            if answer:
                then()

        if isinstance(self.app.screen, QuestionScreen):
            return  # Enter was pressed twice
        self.app.push_screen(QuestionScreen(title, words, yes), answered)

    def _failed(self, line: str, error: BaseException) -> None:
        """Say why a line was not answered, and put it back if the field is empty: nothing typed is lost."""
        before = f"`{line}`: " if line and f"`{line}`" not in str(error) else ""
        self._remark(f"{before}{error}")
        if isinstance(error, LeaseDenied):
            self._remark("Enter again asks whether to take over.")
        if line and not self._entry.value:
            self._entry.value = line
            self._entry.cursor_position = len(line)
        self.show(self._shell.view())

    # Searching.

    def _open_find(self, purpose: Purpose) -> None:
        self._recalled = 0
        self._finder.open(purpose)
        self._entry.display = False

    def _end_find(self, then: Widget) -> None:
        """Leave the search for something else, which has the focus at once."""
        self._entry.display = True
        self.screen.set_focus(then)
        self._finder.close()

    def _recall(self) -> None:
        if self._finder.display and self._finder.purpose is Purpose.HISTORY:
            older = self._asking.history.find(self._finder.value, self._recalled + 1)
            self._recalled += 1 if older is not None else 0
        else:
            self._open_find(Purpose.HISTORY)

    @on(Input.Changed, "FindInput")
    def _searched(self, event: Input.Changed) -> None:
        self._recalled = 0
        if self._finder.purpose is Purpose.LOG and self._finder.display:
            self._pane.search(event.value)
        self.show(self._shell.view())

    @on(Input.Submitted, "FindInput")
    def _searched_for(self, event: Input.Submitted) -> None:
        event.stop()
        if self._finder.purpose is Purpose.HISTORY:
            found = self._asking.history.find(event.value, self._recalled)
            self._put(found if found is not None else self._entry.value)
        else:
            self._end_find(self._pane)
        self.show(self._shell.view())

    # Keys that belong to no command: Enter and Esc.

    def on_key(self, event: events.Key) -> None:
        """Enter in the log begins to type; Esc goes back one layer (the app has stopped the dish first)."""
        view = self._shell.view()
        if event.key == "enter" and self._pane.has_focus and can_release(view) is not None:
            event.stop()
            event.prevent_default()
            self._type()
        elif event.key == "escape":
            event.stop()
            self._back()
        else:
            return
        self.show(self._shell.view())

    @on(FindInput.Left)
    def _left(self, event: FindInput.Left) -> None:
        event.stop()
        self._back()
        self.show(self._shell.view())

    def _back(self) -> None:
        """Take back a first Enter, leave the search, leave the line, close: one of them."""
        if self._asking.armed:
            self._asking.armed = False
        elif self._finder.display:
            to_line = self._finder.purpose is Purpose.HISTORY
            if not to_line:
                self._pane.search("")
            self._end_find(self._entry if to_line else self._pane)
        elif self._pane.needle:
            self._pane.search("")
        elif self._entry.has_focus:
            self.screen.set_focus(self._pane)
        else:
            self._shell.show_page("console")
