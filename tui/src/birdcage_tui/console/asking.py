"""The line on its way from the keyboard to the dish: judged while it is typed, asked about, completed, sent."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.station.raw import CONSOLE, Grade, MenuCommand, Verdict

from birdcage_tui.console import saying
from birdcage_tui.console.complete import Completion, matching, named
from birdcage_tui.console.history import History
from birdcage_tui.console.lines_sent import LinesSent
from birdcage_tui.shown.stop_words import esc_text
from birdcage_tui.shown.view import YOU, View

if TYPE_CHECKING:
    from birdcage.station.access import FaceStation

KEEP_S = 10.0
"""While somebody types, the lease is asked for again so often."""
HARMLESS = Verdict(Grade.HARMLESS, "")
Ask = Callable[[str, str, str, Callable[[], None]], None]
"""Puts a question: title, words, what `y` does in words, and what to do then."""


class Asking:
    """Knows the text in the line, what it would do, and what was said of it."""

    def __init__(
        self, station: FaceStation, sent: LinesSent, history: History, ask: Ask, say: Callable[[str], None]
    ) -> None:
        self._station, self._sent, self._ask, self._say = station, sent, ask, say
        self.history = history
        self.completion = Completion()
        self.text = ""
        self.verdict = HARMLESS
        self.armed = False
        """Whether the next Enter sends a line that changes a setting."""

    def changed(self, text: str, view: View) -> None:
        """The text is another: judge it, and take back a first Enter."""
        if text != self.text:
            self.text, self.armed = text, False
            if saying.talking(view) and view.now - self._sent.last > KEEP_S:
                self._sent.keep(view.now)
        before, self.verdict = self.verdict, self._station.judge(text) if text.strip() else HARMLESS
        if self.verdict != before:
            self.armed = False  # the dish is in another menu now, where the line does something else

    def enter(self, view: View, done: Callable[[], None]) -> None:
        """Take control if need be, then send the line, or ask first. `done` is called when it went out."""
        line = self.text.strip()
        holder = view.state.holder
        if not line:
            if self._sent.under_way or holder == CONSOLE:
                self._sent.end_line(view.now)
            return
        if self._is_held(view):
            self._say(saying.held_words(line, self.verdict, may_move=view.may_move))
            return

        def take() -> None:
            # Polling changes menus: what the line would do is certain only once nothing else is said to the dish.
            self._sent.take_control(
                line, view.now, take_over=holder is not None, then=lambda: self._go(line, view, done)
            )

        if holder == CONSOLE:
            self._go(line, view, done)
        elif holder in (None, YOU):
            take()
        else:
            words = f"{holder} controls the dish. Taking over ends its motion and pauses polling."
            self._ask(f"Take over from {holder}", words, "take over", take)

    def _go(self, line: str, view: View, done: Callable[[], None]) -> None:
        """Judge the line in the menu that the dish is in now; send it, arm it, or ask."""
        if line != self.text.strip():
            return  # somebody typed on meanwhile
        before, self.verdict = self.verdict, self._station.judge(line)
        verdict = self.verdict
        if verdict != before:
            self.armed = False

        def send() -> None:
            if saying.is_worse(self._station.judge(line), verdict):
                self._go(line, view, done)  # it was answered for something else
                return
            self.history.add(line)
            self.armed = False
            self._sent.send(line, verdict, view.now)
            done()

        if saying.asks(verdict):
            self._ask(f"Send  {line}", saying.question_words(verdict), "send it", send)
        elif verdict.grade is Grade.SETTING and not self.armed:
            self.armed = True
        else:
            send()

    def _is_held(self, view: View) -> bool:
        return view.state.held is not None and self.verdict.grade >= Grade.MOVES

    def drop(self) -> None:
        """The app ends: a line that waits for control is not sent."""
        self.text, self.armed = "", False

    def complete(self, view: View) -> str:
        """Return the text after one more Tab."""
        return self.completion.press(self.text, self.commands(view))

    def commands(self, view: View) -> tuple[MenuCommand, ...]:
        """Return what is known of the menu that the dish is in."""
        return self._station.commands(view.state.menu)

    def warns(self, view: View) -> bool:
        """Return whether a hazard is named: not while the text may still become a command that is known."""
        verdict = self.verdict
        begun = not verdict.listed and not self.armed and bool(matching(self.text, self.commands(view)))
        return verdict.grade > Grade.HARMLESS and not begun

    def hint(self, view: View) -> tuple[tuple[str, str], ...]:
        """Return sentences for under the log and their inks: a hazard first, then what helps to type."""
        verdict, commands = self.verdict, self.commands(view)
        command, offered = named(self.text, commands), matching(self.text, commands)
        usage = () if command is None else ((saying.usage_words(command), "dim"),)
        if self._is_held(view):
            return ((saying.held_words(self.text.strip(), verdict, may_move=view.may_move), "warn-row"),)
        if self.warns(view):
            again = "  Enter asks first." if saying.asks(verdict) else "  Enter twice sends it."
            esc = esc_text(view, closes="cancels", other="Backspace cancels")
            again = f"  Enter again sends it, {esc}." if self.armed else again
            hazard = (saying.verdict_words(verdict) + again, saying.GRADES[verdict.grade][0])
            return (hazard, (f"✖ LIMIT: {verdict.limit}", "fault-row")) if verdict.limit else (hazard, *usage)
        if self._sent.under_way:
            sent = self._sent.under_way[-1]
            what = f"`{sent.line}` " if sent.line else ""
            return ((f"{what}running {view.now - sent.at:.0f} s. Enter ends it.", "accent-strong"),)
        if usage:
            return usage
        if self.text.strip() and offered:
            return ((saying.usage_words(offered[0]) if len(offered) == 1 else saying.offer_words(offered), "dim"),)
        return ((self.history.problem, "warn"),) if self.history.problem else ()
