"""The answers to the present step: fields to type into, and a target for each choice."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.step import Choice, Field
from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.message import Message
from textual.widget import Widget
from textual.widgets import Input, Label

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut
from birdcage_tui.setup.form_rows import (
    INDENT,
    MOVES,
    Columns,
    Row,
    arrange,
    button_width,
    columns,
    fold_to,
    key_text,
    unit_text,
)
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane


class ChoiceButton(Pane, can_focus=True):
    """One answer: its key and its words. Enter or a click takes it."""

    BINDINGS = [("enter", "press", "take it")]  # noqa: RUF012
    HELP = "An answer to this step. Choose it with Enter, a click, or its own key."

    class Pressed(Message):
        """A person took this answer."""

        def __init__(self, choice: Choice) -> None:
            super().__init__()
            self.choice = choice

    def __init__(self, choice: Choice, *, asks: bool, live: bool) -> None:
        super().__init__()
        self.choice = choice
        self.live = live
        """Whether it can be taken now; else it is shown as what the step will ask."""
        # What shows its fields is answered from them: Enter in the last one takes it.
        self.can_focus = live and not asks
        self.styles.width = button_width(choice)

    def tell(self, choice: Choice) -> None:
        """Show the same answer with other words."""
        if choice != self.choice:
            self.choice = choice
            self.styles.width = button_width(choice)
            self.redraw()

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Write the key, the words, and whether it moves the dish."""
        key_ink = "accent-row" if self.has_focus else "key" if self.live else "dim"
        # A key that does nothing yet is not named: Enter goes to the step.
        key = key_text(self.choice) if self.live else " " * len(key_text(self.choice))
        x = cells.put(0, 0, f" {key} ", key_ink) + 1
        label = cut(self.choice.label, cells.width - x)
        x = cells.put(x, 0, label, "accent-strong" if self.has_focus else "strong" if self.live else "dim")
        if self.choice.moves:
            cells.put(x + 2, 0, MOVES, "warn" if self.live else "dim")

    def on_focus(self) -> None:
        """Look focused."""
        self.redraw()

    def on_blur(self) -> None:
        """Look as before."""
        self.redraw()

    def on_click(self, event: events.Click) -> None:
        """Take it."""
        event.stop()
        if self.live:
            self.action_press()

    def action_press(self) -> None:
        """Tell the page."""
        self.post_message(self.Pressed(self.choice))


class AnswerForm(Vertical):
    """Rows of fields and choices. `fill` gives it others; `rows` says how many rows they take."""

    class Submitted(Message):
        """A person typed into the fields of a choice, and pressed Enter in the last of them."""

        def __init__(self, choice: Choice) -> None:
            super().__init__()
            self.choice = choice

    HELP = "Type, then Enter. Tab and arrows change the field. At rest, Esc returns to the steps. Ctrl+C stops."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._choices: tuple[Choice, ...] = ()
        self._made: object = None
        self._step = ""
        self._rows: list[Row] = []
        # What is in force now: those that are on their way out are still among the children for a moment.
        self._buttons: list[ChoiceButton] = []
        self._boxes: list[Input] = []
        self._offered: dict[str, str] = {}
        """What each box held before a person typed."""
        self._typed: dict[tuple[str, str], str] = {}
        """What a person typed and has not sent, by step and box: it is there again when the step is."""
        self._opened = ""
        """The choice whose fields are shown where there is no room for all."""
        self.folded: frozenset[str] = frozenset()
        """The choices whose fields are not shown."""

    def compose(self) -> ComposeResult:
        """Nothing before `fill`."""
        yield from ()

    @property
    def rows(self) -> int:
        """How many rows it takes."""
        return len(self._rows)

    def fill(self, step: str, choices: Sequence[Choice], later: Sequence[Choice], width: int, room: int, *,
             apart: bool) -> None:  # fmt: skip
        """Show `choices`, and dim those that can be taken `later`; what was typed stays.

        Fields fold where `room` rows do not hold them all. `apart`: a row for each choice, where they hold that.
        """
        every = (*choices, *later)
        if step != self._step:
            self._opened = ""
        self.folded = fold_to(every, width, room, self._opened)
        for spread in (apart, False):
            rows = [row for each in (choices, later) for row in arrange(each, width, self.folded, apart=spread)]
            if len(rows) <= room:
                break
        made = (step, width, len(choices), self.folded, _shape(rows))
        self._choices = tuple(choices)
        if made == self._made:
            # Words may change every second (the Sun's direction, say): nothing is taken from under a finger for that.
            by_name = {choice.name: choice for choice in every}
            for button in self._buttons:
                button.tell(by_name[button.choice.name])
            return
        self._note_typed()
        focused = self._focused_name()
        self._made, self._step, self._rows = made, step, rows
        self._buttons, self._boxes, self._offered = [], [], {}
        self.remove_children()
        at = columns(every, width)
        self.mount_all(
            [
                Horizontal(*self._widgets(row, at, width), classes="answers" if row[0][1] is None else "answers -more")
                for row in rows
            ]
        )
        if focused is not None:
            self.call_after_refresh(self._focus_name, focused)

    def _widgets(self, row: Row, at: Columns, width: int) -> list[Widget]:
        made: list[Widget] = []
        for choice, field in row:
            live = choice in self._choices
            if field is None:
                asks = bool(choice.fields) and choice.name not in self.folded
                self._buttons.append(ChoiceButton(choice, asks=asks, live=live))
                made.append(self._buttons[-1])
                continue
            label = Label(field.label, markup=False)
            label.styles.width = at.label
            name, unit = _name(choice, field), unit_text(field)
            box = Input(
                value=self._typed.get((self._step, name), field.value), placeholder=field.hint, name=name,
                classes="answer", select_on_focus=True, disabled=not live,
            )  # fmt: skip
            box.styles.width = at.value
            self._boxes.append(box)
            self._offered[name] = field.value
            # The hint stands in an empty field; beside one that is not, as far as there is room.
            free = width - INDENT - at.label - at.value - at.unit - 4
            hint = f"  {field.hint}" if field.value and 0 < cell_len(field.hint) <= free else ""
            made += [label, box, Label(f"{unit:<{at.unit}}{hint}", markup=False, classes="unit")]
        return made

    def _note_typed(self) -> None:
        """Keep what is typed in the boxes that are about to go."""
        for box in self._boxes:
            if box.name is not None and box.value != self._offered[box.name]:
                self._typed[self._step, box.name] = box.value

    def forget(self, step: str) -> None:
        """Drop what was typed in a step: it was sent."""
        self._typed = {key: value for key, value in self._typed.items() if key[0] != step}
        if step == self._step:
            self._offered = {box.name: box.value for box in self._boxes if box.name is not None}

    def _focused_name(self) -> str | None:
        focused = self.screen.focused if self.is_attached else None
        inside = focused is not None and self in focused.ancestors
        return focused.name if inside and isinstance(focused, Input) else None

    def _focus_name(self, name: str) -> None:
        for box in self._boxes:
            if box.name == name:
                self.screen.set_focus(box)

    def values(self, choice: Choice) -> dict[str, str]:
        """Return what stands in the fields of a choice."""
        names = {_name(choice, field): field.name for field in choice.fields}
        return {names[box.name]: box.value for box in self._boxes if box.name in names}

    def focus_button(self, choice: Choice) -> None:
        """Give the focus to the button of a choice, where Enter takes it."""
        for button in self._buttons:
            if button.choice.name == choice.name and button.can_focus:
                self.screen.set_focus(button)

    def focus_fields(self, choice: Choice) -> None:
        """Give the focus to the first field of a choice that is still empty, else to its first; unfold it before."""
        if choice.name in self.folded:
            self._opened = choice.name
            self.call_after_refresh(self.focus_fields, choice)
            return
        names = [_name(choice, field) for field in choice.fields]
        boxes = sorted((box for box in self._boxes if box.name in names), key=lambda box: bool(box.value))
        if boxes:
            self.screen.set_focus(boxes[0])

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go to the next field that is empty; from the last, send what was typed.

        Enter in one that may stay empty, with none after it that may not, sends too.
        """
        event.stop()
        for choice in self._choices:
            names = [_name(choice, field) for field in choice.fields]
            if event.input.name not in names:
                continue
            after = names[names.index(event.input.name) + 1 :]
            left = [box for box in self._boxes if box.name in after and not box.value.strip()]
            passed_over = not event.value.strip() and all(_may_stay_empty(box) for box in (event.input, *left))
            if left and not passed_over:
                self.screen.set_focus(left[0])
            else:
                self.post_message(self.Submitted(choice))
            return

    def on_key(self, event: events.Key) -> None:
        """Up and Down go from field to field; Esc goes back to the steps (STOP came first, if anything moves)."""
        if not isinstance(self.screen.focused, Input):
            return
        if event.key in ("up", "down"):
            event.stop()
            if event.key == "up":
                self.screen.focus_previous()
            else:
                self.screen.focus_next()


def _may_stay_empty(box: Input) -> bool:
    """Return whether the field's hint says so."""
    return "empty" in box.placeholder


def _name(choice: Choice, field: Field) -> str:
    """Return the name of a field's box: two choices may have a field of the same name."""
    return f"{choice.name}/{field.name}"


def _shape(rows: Sequence[Sequence[tuple[Choice, Field | None]]]) -> list[list[tuple[str, str, str]]]:
    """Return what has to be the same for the same widgets to serve again."""
    return [
        [(choice.name, choice.key, "" if field is None else f"{field.name} {field.label}") for choice, field in row]
        for row in rows
    ]
