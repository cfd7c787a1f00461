"""Row 1: link, dish, position, activity, holder, time, and the mouse's STOP. Row 2: what is wrong, or a calm line."""

from __future__ import annotations

from functools import lru_cache

from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.message import Message

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, pad, shorten, wrap
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.state_words import ACTIVITY, LATE, LINK, age_text, bad_day, calm, through, unhomed_word
from birdcage_tui.shown.track_words import STATUS, countdown_s, live_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import has_skew, skew_text

NARROW = 68
"""Below so many columns not every field finds room."""

MUST = 5
"""Fields that share a smaller gap where they do not fit otherwise: link, az, el, activity, who has control."""

ACTIVITY_FIELD = 3
"""Which of them is the activity."""

LEAST_NAME = 6
"""Columns that a longer name of who has control is cut to, at least."""


ATTACHED, DETACHED = (" ATTACHED ", "accent-row"), (" DETACHED ", "fault-row")
"""What stands before the time where another program drives the dish, or did so last; and its ink."""


class StatusLine(Pane):
    """Everything a person must know in one second. Fields keep their widths, so that nothing jumps."""

    INK = "bar"

    def draw(self, cells: Cells, view: View) -> None:
        """Fill from the left by rank; what does not fit is left out, the time never."""
        end = self.right(cells, view)
        x = cells.put(1, 0, f"{view.tag} ", "bar") if view.tag else 1
        fields = self.fields(view, wide=cells.width >= 110)
        whose = fields[MUST - 1]
        if cells.width < NARROW:
            # The big digits below say where it points; who has control stands nowhere else.
            link, az, el, activity, holder, *_ = fields
            fields = [link, holder, activity, (f"{az[0]} {el[0]}", az[1])]  # both or neither
        if cell_len(fields[0][0]) > end - x:  # the name gives way to whether it answers
            fields[0] = (fields[0][0].partition(" ")[2], fields[0][1])
        must = fields[:MUST]
        gap = 2 if x + sum(cell_len(text) for text, _ in must) + 2 * (len(must) - 1) <= end else 1
        for field, ink in fields:
            text = field if x + cell_len(field) <= end else field.rstrip()
            if x + cell_len(text) > end:
                if (field, ink) != whose or end - x < LEAST_NAME:
                    break
                text = cut(text, end - x)
            x = cells.put(x, 0, text, ink) + gap

    def right(self, cells: Cells, view: View) -> int:
        """Write the time, and before it what must not be missed; return the column before that."""
        utc = f"{view.utc:%H:%M:%S}Z"
        end = cells.width - len(utc) - 1
        cells.put(end, 0, utc, "bar")
        end -= 1
        if view.state.demo:
            end -= 6
            cells.put(end, 0, " DEMO ", "target-row")
        if view.via and cells.width >= NARROW:
            words, ink = DETACHED if view.detached else ATTACHED
            end -= len(words)
            cells.put(end, 0, words, ink)
        return end

    @staticmethod
    def fields(view: View, *, wide: bool) -> list[tuple[str, str]]:
        """Return what it says, by rank, each with its ink."""
        state, position = view.state, view.state.position
        glyph, _ = LINK[state.link.state]
        heard = state.link.last_reply
        age = age_text(view.now - heard) if heard is not None else "--"
        name = state.dish.name if state.dish is not None else "dish"
        if not wide:
            words = name.split(" ")  # a year names no dish
            name = (words[0] if words[-1].isdigit() else words[-1])[:8]
        link_ink = "bar" if view.link_up or view.waiting else "bar-warn"
        if view.late:
            glyph, link_ink = LATE, "bar-warn"
        ink = "bar-dim" if view.stale else "bar"
        az = f"{position.az_deg:6.2f}" if position else "---.--"
        el = f"{position.el_deg:5.2f}" if position else "--.--"
        mark = "~" if view.modelled else " "
        activity = "HELD" if state.held is not None and not view.moving else ACTIVITY[state.activity]
        pursuit = pursuit_of(view.state)
        if pursuit is not None and state.held is None:
            error = live_words(view, brief=True)
            if state.demo and not wide:
                error = error.removeprefix("err ")  # else who has control finds no room
            activity = f"{STATUS[pursuit.phase]} {error}".rstrip()
            left_s = countdown_s(view)
            activity += f" {max(left_s, 0.0):.0f} s" if left_s is not None else ""
        if not view.link_up:
            activity = LINK[state.link.state][1].upper()
        elif state.fault is not None and not view.may_move and state.held is None:
            activity = "FAULT"
        elif state.homed is False and not view.moving and state.held is None:
            activity = unhomed_word(view)
        holder = cut(state.holder or ("free" if wide else ""), 16)
        holder = f"control: {holder}" if wide else holder
        fields = [
            (f"{name} {glyph} {age:<4}", link_ink),
            (f"AZ{mark}{az}°", ink),
            (f"EL{mark}{el}°", ink),
            (f"{activity:<9}", "bar"),
            (
                pad(holder, max(cell_len(holder), 16 if wide else 9)),
                "bar-dim" if state.holder is None else "bar",
            ),
        ]
        if has_skew(view):
            fields.append((f"SK{skew_text(view)}", ink))
        leans = state.alignment.model is not None
        if state.az_offset_deg or state.el_offset_deg or leans:
            tilt = " tilt" if leans else ""
            fields.append((f"offset {state.az_offset_deg:+.2f} {state.el_offset_deg:+.2f}{tilt}", "bar"))
        if wide and state.port:
            fields.append((through(state.port.split("?")[0], view), "bar-dim"))
        if wide and state.firmware_version:
            fields.append((f"firmware {state.firmware_version}", "bar-dim"))
        return fields


class StopButton(Pane):
    """STOP for the mouse, in row 1 of every page. It acts on the press, not on the click."""

    INK = "fault-row"

    class Pressed(Message):
        """A person pressed it."""

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Say what it is."""
        cells.put(1, 0, "■ STOP", "fault-row")

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Stop at once."""
        event.stop()
        self.post_message(self.Pressed())


class TopRow(Horizontal):
    """Row 1. Dialogs have one too: status and STOP are never covered."""

    def compose(self) -> ComposeResult:
        """What is known, and STOP."""
        yield StatusLine()
        yield StopButton()

    def show(self, view: View) -> None:
        """Hand the view to both."""
        for pane in self.children:
            if isinstance(pane, Pane):
                pane.show(view)


@lru_cache(maxsize=8)
def _wrapped(words: str, width: int, most: int) -> tuple[str, ...]:
    """Return the rows, Enter beside what it does: the same for many frames."""
    rows = wrap(words.replace("Enter ", "Enter\N{NO-BREAK SPACE}"), width, most=most)
    return tuple(row.replace("\N{NO-BREAK SPACE}", " ") for row in rows)


class BadDayRow(Pane):
    """Row 2: HELD, LINK LOST, SILENT, NOT HOMED, FAULT in words; else the calm line. Grows when words need room."""

    LONGEST = 4
    """Rows: what is wrong stands here alone, and whole."""

    def lines(self, view: View, width: int) -> tuple[str, list[str]]:
        """Return the ink and the wrapped rows, one at least."""
        found = bad_day(view)
        ink, words = ("dim", calm(view)) if found is None else found
        rows = [*_wrapped(words, max(width - 2, 10), self.LONGEST)]
        if found is None and len(rows) > 1:
            rows = [shorten(words, width - 2)]
        return ink, rows or [""]

    def show(self, view: View) -> None:
        """Take as many rows as the words need."""
        _, rows = self.lines(view, self.size.width or 80)
        if self.styles.height is None or self.styles.height.value != len(rows):
            self.styles.height = len(rows)
        super().show(view)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the words, in colour over the whole width when something is wrong."""
        ink, rows = self.lines(view, cells.width)
        for y in range(cells.height):
            cells.put(0, y, pad(f" {rows[y] if y < len(rows) else ''}", cells.width), ink)

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Enter's mouse target: release, acknowledge or accept."""
        event.stop()
        if self.view is not None and can_release(self.view) is None:
            self.post_message(self.Pressed(self.view.tag))

    class Pressed(Message):
        """A person pressed the row while it told of the dish with this tag."""

        def __init__(self, tag: str) -> None:
            super().__init__()
            self.tag = tag
