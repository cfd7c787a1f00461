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

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import cut
from birdcage_tui.pane import Pane
from birdcage_tui.view import View

MOVES = "▲ moves the dish"
GAP = 2
INDENT = 4
"""Of a row that goes on with the fields of the choice above."""
LEAST_FIELD, MOST_FIELD = 12, 30


class ChoiceButton(Pane, can_focus=True):
    """One answer: its key and its words. Enter or a click takes it."""

    BINDINGS = [("enter", "press", "take it")]  # noqa: RUF012
    HELP = "An answer to this step. Choose it with Enter, a click, or its own key."

    class Pressed(Message):
        """A person took this answer."""

        def __init__(self, choice: Choice) -> None:
            super().__init__()
            self.choice = choice

    def __init__(self, choice: Choice) -> None:
        super().__init__()
        self.choice = choice
        # What has fields is answered from them: Enter in the last one takes it.
        self.can_focus = not choice.fields
        self.styles.width = button_width(choice)

    def tell(self, choice: Choice) -> None:
        """Show the same answer with other words."""
        if choice != self.choice:
            self.choice = choice
            self.styles.width = button_width(choice)
            self.redraw()

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Write the key, the words, and whether it moves the dish."""
        key = "Enter" if self.choice.key == "enter" else self.choice.key
        x = cells.put(0, 0, f" {key} ", "accent-row" if self.has_focus else "key") + 1
        label = cut(self.choice.label, cells.width - x)
        x = cells.put(x, 0, label, "accent-strong" if self.has_focus else "strong")
        if self.choice.moves:
            cells.put(x + 2, 0, MOVES, "warn")

    def on_focus(self) -> None:
        """Look focused."""
        self.redraw()

    def on_blur(self) -> None:
        """Look as before."""
        self.redraw()

    def on_click(self, event: events.Click) -> None:
        """Take it."""
        event.stop()
        self.action_press()

    def action_press(self) -> None:
        """Tell the page."""
        self.post_message(self.Pressed(self.choice))


def button_width(choice: Choice) -> int:
    """Return how many columns a choice takes."""
    key = "Enter" if choice.key == "enter" else choice.key
    return len(key) + 3 + len(choice.label) + (len(MOVES) + 2 if choice.moves else 0)


def field_width(field: Field) -> int:
    """Return how many columns there are to type in."""
    return min(max(len(field.value or field.hint) + 3, LEAST_FIELD), MOST_FIELD)


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
        self._rows: list[list[tuple[Choice, Field | None]]] = []
        # What is in force now: those that are on their way out are still among the children for a moment.
        self._buttons: list[ChoiceButton] = []
        self._boxes: list[Input] = []

    def compose(self) -> ComposeResult:
        """Nothing before `fill`."""
        yield from ()

    @property
    def rows(self) -> int:
        """How many rows it takes."""
        return len(self._rows)

    def fill(self, step: str, choices: Sequence[Choice], width: int) -> None:
        """Show these choices; what was typed stays as long as they are the same."""
        rows = packed(choices, width)
        made = (step, width, _shape(rows))
        self._choices = tuple(choices)
        if made == self._made:
            # Words may change every second (the Sun's direction, say): nothing is taken from under a finger for that.
            by_name = {choice.name: choice for choice in choices}
            for button in self._buttons:
                button.tell(by_name[button.choice.name])
            return
        typed = {box.name: box.value for box in self._boxes} if self._step == step else {}
        focused = self._focused_name()
        self._made, self._step, self._rows = made, step, rows
        self._buttons, self._boxes = [], []
        self.remove_children()
        self.mount_all(
            [
                Horizontal(*self._widgets(row, typed), classes="answers" if row[0][1] is None else "answers -more")
                for row in rows
            ]
        )
        if focused is not None:
            self.call_after_refresh(self._focus_name, focused)

    def _widgets(self, row: list[tuple[Choice, Field | None]], typed: dict[str | None, str]) -> list[Widget]:
        made: list[Widget] = []
        for choice, field in row:
            if field is None:
                self._buttons.append(ChoiceButton(choice))
                made.append(self._buttons[-1])
                continue
            made.append(Label(field.label, markup=False))
            box = Input(
                value=typed.get(_name(choice, field), field.value), placeholder=field.hint, name=_name(choice, field),
                classes="answer", select_on_focus=True,
            )  # fmt: skip
            box.styles.width = field_width(field)
            self._boxes.append(box)
            made += [box, Label(field.unit.replace("deg", "°"), markup=False, classes="unit")]
        return made

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

    def focus_fields(self, choice: Choice) -> None:
        """Give the focus to the first field of a choice that is still empty, else to its first."""
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


def packed(choices: Sequence[Choice], width: int) -> list[list[tuple[Choice, Field | None]]]:
    """Return rows of (choice, field) or (choice, None) for its button; fields stand after their button."""
    rows: list[list[tuple[Choice, Field | None]]] = []
    free = 0
    typed = False
    for choice in choices:
        begins = bool(choice.fields) or typed
        typed = bool(choice.fields)
        items: list[tuple[Field | None, int]] = [(None, button_width(choice) + GAP)]
        items += [
            (field, len(field.label) + 1 + field_width(field) + 1 + len(field.unit) + GAP) for field in choice.fields
        ]
        for field, needs in items:
            if begins or needs > free:
                rows.append([])
                free, begins = width - (INDENT if field is not None else 0), False
            rows[-1].append((choice, field))
            free -= needs
    return rows
