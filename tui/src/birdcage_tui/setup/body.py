"""What the setup page shows, and where: the list with the step unfolded in it, or both side by side."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from birdcage.setup.case import Cause
from birdcage.setup.step import Choice, StepView
from textual.app import ComposeResult
from textual.containers import Vertical, VerticalScroll
from textual.widget import Widget
from textual.widgets import Input

from birdcage_tui.pages.page import Page
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.settings import Place
from birdcage_tui.setup.causes import told_apart
from birdcage_tui.setup.engine import SetupEngine, SetupHost
from birdcage_tui.setup.extra import ExtraPane, Kind, kind_for
from birdcage_tui.setup.fold import fold
from birdcage_tui.setup.form import AnswerForm
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.setup.words import StepWords, Telling
from birdcage_tui.view import View

TITLE = "Setup: from wires to the first satellite"
HERE = Choice("here", "enter", "Make this the present step")
HAND_STEPS = ("north", "first")
"""Steps at which a person may want to move the dish by hand."""
LEAST_BELOW = 14
"""Rows from which a compass is worth drawing under the readings."""
LEAST_LIST = 3
"""Rows that the list keeps, whatever the present step needs."""
POINTING_ROWS = 13
FINISHED = (
    "Setup is finished: every step is done, skipped or for later. 1 shows the sky, 2 moves the dish by hand.",
    "Any step can be done again: look at it with the arrows, then Enter. After each power-up the dish has to be homed.",
)


class SetupBody(Page):
    """Lays out list, words, answers and what belongs under them, for the step that is looked at."""

    WATCHES = frozenset({"position", "health"})
    FIRST_FOCUS = "#setup-steps"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = TITLE
        self.looked = 0
        self.wrong = ""
        """Why the last answer was not taken."""
        self.note = ""
        """A sentence about the last key. Row 2 may be taken by what is wrong with the dish."""
        self.wiring = False
        self.limits_asked = False
        self.chosen = 0
        """Which of the causes is unfolded."""
        self.causes: tuple[Cause, ...] = ()
        self._steps: tuple[StepView, ...] = ()
        self._present = ""
        self._busy: tuple[str, float] | None = None
        self._shape: object = None

    def compose(self) -> ComposeResult:
        """The list above, the step, the list below; wider, list and step side by side."""
        with Vertical(id="setup-list") as column:
            column.border_title = TITLE
            steps = StepsPane(id="setup-steps")
            steps.can_focus = True
            yield steps
        with VerticalScroll(id="setup-step", can_focus=False):
            yield StepWords(id="setup-words")
            yield AnswerForm(id="setup-form")
            yield ExtraPane(id="setup-extra")
            yield PointingPane(id="setup-pointing")
            yield ExtraPane(id="setup-below")
        yield StepsPane(id="setup-rest")

    def on_mount(self) -> None:
        """Make the engine, and look at its present step."""
        make = self.host.settings.setup
        assert make is not None, "the page is only made with an engine behind it"
        self.engine: SetupEngine = make()
        self._steps = self.engine.steps()
        self.follow()

    @property
    def host(self) -> SetupHost:
        """The app."""
        return cast(SetupHost, self.app)

    @property
    def form(self) -> AnswerForm:
        """The answers."""
        return self.query_one(AnswerForm)

    @property
    def step(self) -> StepView:
        """The step that is looked at."""
        return self._steps[self.looked]

    @property
    def baud_that_mends(self) -> int | None:
        """The rate that the chosen cause asks for."""
        chosen = self.causes[self.chosen : self.chosen + 1]
        return chosen[0].use_baud if chosen else None

    @property
    def typing(self) -> bool:
        """Whether a text field has the focus."""
        return isinstance(self.screen.focused, Input)

    @property
    def wide(self) -> bool:
        """Whether list and step stand side by side."""
        return self.app.screen_stack[0].has_class("-wide")

    @property
    def wiring_fills(self) -> bool:
        """Whether the wiring stands instead of words and answers."""
        return self.wiring

    def answers(self) -> tuple[Choice, ...]:
        """Return what can be answered now: only the present step is answered."""
        step = self.step
        if step.name != self._present:
            return (HERE,)
        choices = step.choices
        baud = self.baud_that_mends
        if baud is not None and choices and not any(choice.name == "connect" for choice in choices):
            return (Choice("use-baud", "u", f"Use {baud} baud"), *choices)
        return choices

    def look_at(self, index: int) -> None:
        """Look at another step."""
        index = min(max(index, 0), len(self._steps) - 1)
        if index != self.looked:
            self.looked, self.wrong, self.note = index, "", ""
        self.host.paint()

    def follow(self) -> None:
        """Look at the present step."""
        self._present = self.engine.current
        self.look_at(next(index for index, step in enumerate(self._steps) if step.name == self._present))

    def remark(self, words: str) -> None:
        """Say something under the words of the step."""
        self.note, self.wrong = words, ""
        self.host.paint()

    def focus_steps(self) -> None:
        """Give the keys to the page."""
        self.screen.set_focus(self.query_one("#setup-steps"))

    def scroll_wiring(self, by: int) -> None:
        """Move the wiring up or down by some rows."""
        self.query_one("#setup-step", VerticalScroll).scroll_relative(y=by * 4, animate=False)

    # One frame.

    def show(self, view: View) -> None:
        """Let the engine go on, and draw what it says."""
        if not self.is_attached or not self._steps or not self.size:
            return
        self.engine.tick()
        self._steps = self.engine.steps()
        if self.engine.current != self._present:
            self.follow_soon()
        if self.screen.focused is None and self.app.screen is self.screen:
            self.focus_steps()
        self._tell_place()
        self._find_causes(view)
        self._fill(view)
        shape = self._lay_out()
        super().show(view)
        if shape != self._shape:
            # Widths and heights follow only after this frame: look once more when they have.
            self._shape = shape
            self.call_after_refresh(self.host.paint)

    def on_resize(self) -> None:
        """Lay out at the new size."""
        self.call_after_refresh(self.host.paint)

    def follow_soon(self) -> None:
        """Go along with the engine to its next step."""
        self._present = self.engine.current
        self.looked = next(index for index, step in enumerate(self._steps) if step.name == self._present)
        self.wrong, self.note, self.wiring = "", "", False

    def _find_causes(self, view: View) -> None:
        """Take the causes of silence; with others, the walk begins anew."""
        causes = self.engine.causes() if view.state.port else ()
        if [cause.title for cause in causes] != [cause.title for cause in self.causes]:
            self.chosen = 0
        self.causes = causes

    def walk(self, by: int) -> None:
        """Go to another cause."""
        self.chosen = min(max(self.chosen + by, 0), max(len(self.causes) - 1, 0))
        self.host.paint()

    def _tell_place(self) -> None:
        """Let every page know where the dish stands, as soon as the setup does."""
        place, host = self.engine.settings.place, self.host
        if place.latitude_deg is None or place.longitude_deg is None:
            return
        here = Place(place.latitude_deg, place.longitude_deg, place.name or "")
        if host.settings.place != here:
            host.settings = replace(host.settings, place=here)

    def _fill(self, view: View) -> None:
        step, present = self.step, self.step.name == self._present
        if not step.busy:
            self._busy = None
        elif self._busy is None or self._busy[0] != step.name:
            self._busy = (step.name, view.now)
        kind = kind_for(step.name, mute=bool(self.causes), wiring_asked=self.wiring, wide=self.wide)
        extra = self.query_one("#setup-extra", ExtraPane)
        told, extra.seen = step, ""
        if kind is Kind.CAUSES:
            words, extra.seen = told_apart(step, self.causes, view.state.link.detail)
            told = replace(step, words=words)
        self.query_one(StepWords).telling = Telling(
            told,
            present,
            None if self._busy is None else view.now - self._busy[1],
            wrong=self.wrong,
            whole=kind is not Kind.CAUSES and not step.busy and self.query_one("#setup-steps", StepsPane).cuts(step),
            news=FINISHED if present and self.engine.finished else (),
            extra=_asides(step, view) if present else (),
            note=self.note,
        )
        extra.kind, extra.causes, extra.chosen, extra.place = kind, self.causes, self.chosen, view.settings.place
        dish = view.state.dish
        extra.firmware = None if dish is None else dish.firmware

    def _lay_out(self) -> object:
        """Give every part its rows. Return what the layout was made from."""
        words, form, extra = self.query_one(StepWords), self.form, self.query_one("#setup-extra", ExtraPane)
        scroll = self.query_one("#setup-step", VerticalScroll)
        fills, wide = self.wiring_fills, self.wide
        width = scroll.size.width or self.size.width - 8
        words.display = form.display = not fills
        form.fill(self.step.name, self.answers(), width)
        told = 0 if fills else words.rows(width)
        asked = 0 if fills else form.rows
        # A row of air above and below the answers, where the list does not need it.
        spare = extra.kind is Kind.NOTHING and self.size.height - told - asked - len(self._steps) >= 2
        airy = asked > 0 and (wide or spare)
        form.set_class(airy, "-airy")
        asked += 2 if airy else 0
        _rows(words, told)
        _rows(form, form.rows)
        room = self._lay_out_wide() if wide else self._lay_out_narrow(told + asked, extra.kind is not Kind.NOTHING)
        extra.display = extra.kind is not Kind.NOTHING
        pointing = self.query_one(PointingPane)
        pointing.display = extra.kind is Kind.POINTING
        extra.alone = fills
        below = self.query_one("#setup-below", ExtraPane)
        below.kind, below.place = Kind.COMPASS, extra.place
        left = room - told - asked - 2 - POINTING_ROWS
        below.display = extra.kind is Kind.POINTING and left >= LEAST_BELOW
        if extra.kind is Kind.POINTING:
            _rows(extra, 2)
            _rows(pointing, POINTING_ROWS if left >= 0 else max(left + POINTING_ROWS, 7))
            _rows(below, max(left, 0))
        elif extra.display:
            needs = extra.wiring_rows(width) if fills else 0
            _rows(extra, max(room - told - asked, needs))
        return self.size, width, wide, told, asked, room, self.looked, extra.kind, self._present

    def _lay_out_narrow(self, needs: int, has_extra: bool) -> int:
        """List and step in one column. Return the rows that the step has."""
        height, count = self.size.height, len(self._steps)
        least = LEAST_LIST if has_extra else min(max(height - needs, LEAST_LIST), count)
        listed = 0 if self.wiring_fills else least
        rows = fold(count, self.looked, listed)
        upper = [row for row in rows if row.first <= self.looked]
        lower = [row for row in rows if row.first > self.looked]
        steps = self.query_one("#setup-steps", StepsPane)
        steps.tall = False
        steps.tell(self._steps, upper, self.looked, self._present)
        rest = self.query_one("#setup-rest", StepsPane)
        rest.tell(self._steps, lower, self.looked, self._present)
        rest.display = bool(lower) and listed > 0
        self.query_one("#setup-list").display = listed > 0
        _rows(self.query_one("#setup-list"), len(upper))
        _rows(rest, len(lower))
        step_rows = height - listed
        _rows(self.query_one("#setup-step"), step_rows if has_extra else min(needs, step_rows))
        return step_rows

    def _lay_out_wide(self) -> int:
        """List at the left. Return the rows that the step has."""
        steps, frame = self.query_one("#setup-steps", StepsPane), self.query_one("#setup-list")
        column = self.query_one("#setup-step")
        frame.display = True
        for part in (frame, column):
            part.styles.height = "1fr"
        column.border_title = f"{self.step.number} {self.step.title}"
        self.query_one("#setup-rest").display = False
        steps.tall = True
        steps.tell(self._steps, fold(len(self._steps), self.looked, max(frame.size.height, 1)), self.looked,
                   self._present)  # fmt: skip
        return column.size.height


def _asides(step: StepView, view: View) -> tuple[str, ...]:
    """Return what the page itself has to add to a step."""
    state = view.state
    if state.fault is not None:
        return ("Enter acknowledges the fault first; after that it does the step.",)
    if state.held is not None:
        return ("Enter lets go of HELD first; after that it does the step.",)
    if step.name in HAND_STEPS and step.choices:
        return ("Arrows do not jog here: o opens Control, where they do; 8 comes back.",)
    return ()


def _rows(widget: Widget, rows: int) -> None:
    """Make a widget so many rows tall, if it is not."""
    height = widget.styles.height
    if height is None or height.value != rows or not height.is_cells:
        widget.styles.height = rows
