"""The go-to line: lies over the last rows while it is open, and says what Enter would do while one types."""

from __future__ import annotations

from typing import cast

from birdcage.station.requests import Goto, TurnSkew
from textual import events, on
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Input, Label

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.goto.goto_skew import is_skew, skew_of, skew_way
from birdcage_tui.goto.goto_target import StillLooking, aim_of, asks_for, located_of
from birdcage_tui.goto.goto_text import EXAMPLES
from birdcage_tui.goto.reach import refusal_of, way_words
from birdcage_tui.shown.allowed import can_move
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.cancel import CancelButton
from birdcage_tui.widgets.esc_field import EscField
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import has_skew

ROWS, MOST_ROWS = 2, 5
"""Of what Enter would do, and where the terminal is narrow."""


def held_back(view: View) -> str | None:
    """Return why nothing can be sent anywhere now, and what to do from inside the line; None when it can."""
    reason = can_move(view)
    if reason is None or ". Enter " not in reason:
        return reason
    first = "Once it rests, Esc closes" if view.may_move else "Esc closes"
    return reason.replace(". Enter ", f". {first} this line, then Enter ")


def _enter(words: str, view: View, width: int) -> str:
    """Return what Enter would do; where there is room in two rows, also which pass it ends."""
    pursuit = pursuit_of(view.state)
    if pursuit is not None and view.state.holder == pursuit.holder:
        ends = f"Enter ends {pursuit.plan.aim.name}: {words}"
        if len(wrap(ends, width)) <= ROWS:
            return ends
    return f"Enter: {words}"


def _outside(reason: str, view: View) -> str:
    """Return a reason with what sets the location from inside the line, where a letter is only typed."""
    first = "Tab, Enter, then L," if view.may_move else "Esc, then L,"
    return reason.replace(NO_LOCATION, NO_LOCATION.replace("L sets", f"{first} sets"))


def foretell(text: str, view: View, width: int = 78) -> tuple[str, str]:
    """Return the ink and the words for what Enter would do with `text`, for rows of `width` columns."""
    if not text.strip():
        more = " skew 45 turns the feed." if has_skew(view) else ""
        return "dim", f"Type {EXAMPLES}. A sign adds to the last target.{more}"
    if is_skew(text):
        return _foretell_skew(text, view, width)
    try:
        aim = aim_of(text, view)
    except StillLooking as wait:
        return "dim", str(wait)
    except ValueError as wrong:
        return "warn", f"▲ {_outside(str(wrong), view)}"
    reason = held_back(view) or refusal_of(Goto(aim.az_deg, aim.el_deg, YOU), view.state)
    if reason is not None:
        return "warn", f"▲ Refused: {reason}"
    return "text", _enter(f"{way_words(view, aim)}{f'   {aim.skew}' if aim.skew else ''}", view, width)


def _foretell_skew(text: str, view: View, width: int) -> tuple[str, str]:
    try:
        words, deg = skew_way(text, view), skew_of(text, view)
    except ValueError as wrong:
        return "warn", f"▲ {wrong}"
    reason = held_back(view) or refusal_of(TurnSkew(deg, YOU), view.state)
    return ("text", _enter(words, view, width)) if reason is None else ("warn", f"▲ Refused: {reason}")


class GotoPreview(Pane):
    """What Enter would do, in two rows, or in as many as it needs."""

    INK = "bar"

    def __init__(self) -> None:
        super().__init__()
        self.text = ""

    def rows(self, width: int, view: View) -> tuple[str, list[str]]:
        """Return the ink, and the words in rows of so many cells."""
        ink, words = foretell(self.text, view, width)
        return ink, wrap(words, width, most=MOST_ROWS)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the words."""
        ink, rows = self.rows(max(cells.width - 2, 10), view)
        for y, row in enumerate(rows):
            cells.put(1, y, row, {"text": "bar", "dim": "bar-dim", "warn": "bar-warn"}[ink])


class GotoLine(Vertical):
    """A field and what Enter would do; Enter sends it, and what had the focus has it again."""

    class Sent(Message):
        """A direction to go to."""

        def __init__(self, az_deg: float, el_deg: float) -> None:
            super().__init__()
            self.az_deg, self.el_deg = az_deg, el_deg

    class SkewSent(Message):
        """An angle to turn the skew to."""

        def __init__(self, deg: float) -> None:
            super().__init__()
            self.deg = deg

    def __init__(self) -> None:
        super().__init__()
        self._before: Widget | None = None
        self._entered: str | None = None
        """What Enter was pressed for while the desk was still looking for it."""
        self._located = ""
        """What the desk was asked to look up last."""

    @property
    def is_open(self) -> bool:
        """Whether it is seen."""
        return self.has_class("-open")

    def compose(self) -> ComposeResult:
        """A label and a field, which has no focus before `open`; the preview."""
        with Horizontal():
            yield Label("go to")
            yield EscField("Enter goes there", "Enter: go", closes="closes")
            yield CancelButton()
        yield GotoPreview()

    def open(self, text: str = "") -> None:
        """Show the line with `text` in it and take the focus."""
        field = self.query_one(Input)
        if not self.is_open:
            self._before = self.screen.focused
        self.add_class("-open")
        field.disabled = False
        field.value = text
        field.select_on_focus = not text.endswith(" ")  # a word that waits for its number is not to be typed over
        field.cursor_position = len(text)
        field.focus()
        self._foretell(text)

    def close(self) -> None:
        """Hide the line and give the focus back."""
        self._entered = None
        self._locate("")
        self.remove_class("-open")
        self.query_one(Input).disabled = True
        cast(AppHost, self.app).aim = None
        before, self._before = self._before, None
        back = before is not None and before.is_attached and before.focusable
        self.screen.set_focus(before if back else None)

    def show(self, view: View) -> None:
        """Foretell from where things stand now."""
        if not self.is_open:
            return
        preview = self.query_one(GotoPreview)
        cast(AppHost, self.app).aim = self._aim(preview.text, view)
        rows = max(len(preview.rows(max(self.size.width - 2, 10), view)[1]), ROWS) if self.size.width else ROWS
        if preview.styles.height is None or preview.styles.height.value != rows:
            preview.styles.height, self.styles.height = rows, rows + 1
        preview.show(view)
        if self._entered is not None and located_of(self._entered, view) is not None:
            text, self._entered = self._entered, None
            self.call_later(self._send, text)

    def _foretell(self, text: str) -> None:
        host = cast(AppHost, self.app)
        self.query_one(GotoPreview).text = text
        view = host.view()
        self._locate("" if is_skew(text) else asks_for(text, view))
        host.aim = self._aim(text, view)
        host.paint()

    def _locate(self, text: str) -> None:
        """Have the desk say where a target stands as long as its name stands here."""
        source = cast(AppHost, self.app).track.source
        if source is not None and text != self._located:
            self._located = text
            source.locate(text)

    @staticmethod
    def _aim(text: str, view: View) -> tuple[float, float] | None:
        try:
            aim = aim_of("" if is_skew(text) else text, view)
        except ValueError:
            return None
        return aim.az_deg, aim.el_deg

    def on_input_changed(self, event: Input.Changed) -> None:
        """Say what it means so far."""
        event.stop()
        self._entered = None
        self._foretell(event.value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Send what was typed; what cannot be read, or not be sent now, stays there, and the line below says why."""
        event.stop()
        self._send(event.value)

    def _send(self, text: str) -> None:
        if not self.is_open or self.query_one(Input).value != text:
            return
        view = cast(AppHost, self.app).view()
        sent: GotoLine.Sent | GotoLine.SkewSent
        try:
            if is_skew(text):
                sent = self.SkewSent(skew_of(text, view))
            else:
                aim = aim_of(text, view)
                sent = self.Sent(aim.az_deg, aim.el_deg)
        except StillLooking:
            self._entered = text
            self._foretell(text)
            return
        except ValueError:
            self._foretell(text)
            return
        request = Goto(sent.az_deg, sent.el_deg, YOU) if isinstance(sent, self.Sent) else TurnSkew(sent.deg, YOU)
        if (held_back(view) or refusal_of(request, view.state)) is not None:
            self._foretell(text)
            return
        self.close()
        self.post_message(sent)

    @on(EscField.Left)
    @on(CancelButton.Pressed)
    def _left(self, event: Message) -> None:
        event.stop()
        self.close()

    def on_key(self, event: events.Key) -> None:
        """Esc closes the line (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.close()
