"""Gives the parts of the setup page their rows: the step unfolded in the list, or list and step side by side."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.step import Choice, StepView
from textual.containers import VerticalScroll
from textual.geometry import Size
from textual.widget import Widget

from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.setup.extra import ExtraKind, ExtraPane
from birdcage_tui.setup.fold import fold
from birdcage_tui.setup.form import AnswerForm
from birdcage_tui.setup.setup_words import StepWords
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.widgets.page import Page

LEAST_BELOW = 14
"""Rows from which a compass is worth drawing under the readings."""
LEAST_LIST = 3
"""Rows that the list keeps, whatever the present step needs."""
LEAST_CAUSES = 12
"""Rows that the walk through the causes gets before fields do."""
POINTING_ROWS = 13
"""What the readings take when there is room."""


class SetupLayout(Page):
    """The page as far as its layout depends on it."""

    views: tuple[StepView, ...] = ()
    """All steps, in order."""
    looked = 0
    """The index of the step that is looked at."""
    present = ""
    """The name of the step that is answered."""
    wiring = False
    """Whether the wiring was asked for."""

    @property
    def form(self) -> AnswerForm:
        """The answers."""
        return self.query_one(AnswerForm)

    @property
    def room(self) -> Size:
        """How large it is under the tabs."""
        return self.query_one("#setup-frame").size

    @property
    def step(self) -> StepView:
        """The step that is looked at."""
        return self.views[self.looked]

    @property
    def wide(self) -> bool:
        """Whether list and step stand side by side."""
        return self.app.screen_stack[0].has_class("-wide")

    @property
    def wiring_fills(self) -> bool:
        """Whether the wiring stands instead of words and answers."""
        return self.wiring

    def answers(self) -> Sequence[Choice]:
        """Return what can be answered now."""
        raise NotImplementedError

    def later(self) -> Sequence[Choice]:
        """Return what the step that is looked at will ask, once it is the present one; empty while it is."""
        raise NotImplementedError


def lay_out(page: SetupLayout) -> object:
    """Give every part its rows. Return what the layout was made from."""
    words, form, extra = page.query_one(StepWords), page.form, page.query_one("#setup-extra", ExtraPane)
    scroll = page.query_one("#setup-step", VerticalScroll)
    fills, wide = page.wiring_fills, page.wide
    width = scroll.size.width or page.room.width - 8
    words.display = form.display = not fills
    told = 0 if fills else words.rows(width)
    height = scroll.size.height if wide else page.room.height - LEAST_LIST
    kept = (2 if wide else 0) + (LEAST_CAUSES if extra.kind is ExtraKind.CAUSES else 0)
    form.fill(page.step.name, page.answers(), page.later(), width, height - told - kept, apart=wide)
    asked = 0 if fills else form.rows
    # A row of air above and below the answers, where the list does not need it.
    spare = extra.kind is ExtraKind.NOTHING and page.room.height - told - asked - len(page.views) >= 2
    airy = not fills and (wide or (asked > 0 and spare))
    form.set_class(airy, "-airy")
    asked += 2 if airy else 0
    _rows(words, told)
    _rows(form, form.rows)
    room = _wide(page) if wide else _narrow(page, told + asked, has_extra=extra.kind is not ExtraKind.NOTHING)
    extra.display = extra.kind is not ExtraKind.NOTHING
    pointing = page.query_one(PointingPane)
    pointing.display = extra.kind is ExtraKind.POINTING
    extra.alone = fills
    below = page.query_one("#setup-below", ExtraPane)
    below.kind, below.place = ExtraKind.COMPASS, extra.place
    left = room - told - asked - 2 - POINTING_ROWS
    below.display = extra.kind is ExtraKind.POINTING and left >= LEAST_BELOW
    if extra.kind is ExtraKind.POINTING:
        _rows(extra, 2)
        _rows(pointing, POINTING_ROWS if left >= 0 else max(left + POINTING_ROWS, 7))
        _rows(below, max(left, 0))
    elif extra.display:
        # The column counts the scrollbar that its parts do not have.
        needs = extra.wiring_rows(min(width, extra.size.width or width)) if fills else 0
        _rows(extra, max(room - told - asked, needs))
    return page.room, width, wide, told, asked, room, page.looked, extra.kind, page.present


def _narrow(page: SetupLayout, needs: int, *, has_extra: bool) -> int:
    """List and step in one column. Return the rows that the step has."""
    height, count = page.room.height, len(page.views)
    least = LEAST_LIST if has_extra else min(max(height - needs, LEAST_LIST), count)
    listed = 0 if page.wiring_fills else least
    rows = fold(count, page.looked, listed)
    upper = [row for row in rows if row.first <= page.looked]
    lower = [row for row in rows if row.first > page.looked]
    steps = page.query_one("#setup-steps", StepsPane)
    steps.tall = False
    steps.tell(page.views, upper, page.looked, page.present)
    rest = page.query_one("#setup-rest", StepsPane)
    rest.tell(page.views, lower, page.looked, page.present)
    rest.display = bool(lower) and listed > 0
    page.query_one("#setup-list").display = listed > 0
    _rows(page.query_one("#setup-list"), len(upper))
    _rows(rest, len(lower))
    step_rows = height - listed
    _rows(page.query_one("#setup-step"), step_rows if has_extra else min(needs, step_rows))
    return step_rows


def _wide(page: SetupLayout) -> int:
    """List at the left. Return the rows that the step has."""
    steps, frame = page.query_one("#setup-steps", StepsPane), page.query_one("#setup-list")
    column = page.query_one("#setup-step")
    frame.display = True
    for part in (frame, column):
        part.styles.height = "1fr"
    column.border_title = f"{page.step.number} {page.step.title}"
    page.query_one("#setup-rest").display = False
    steps.tall = True
    steps.tell(page.views, fold(len(page.views), page.looked, max(frame.size.height, 1)), page.looked,
               page.present)  # fmt: skip
    return column.size.height


def _rows(widget: Widget, rows: int) -> None:
    """Make a widget so many rows tall, if it is not."""
    height = widget.styles.height
    if height is None or height.value != rows or not height.is_cells:
        widget.styles.height = rows
