"""How far it is from here to the strongest signal, and which way."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.drawing.digits import put_big
from birdcage_tui.shown.event_words import finding_now, finding_words
from birdcage_tui.shown.level_words import NEAR_DEG, arrow, followed_name, turn_to, value_text
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.signal.level import is_large
from birdcage_tui.widgets.pane import Pane

LED_BY_PLAN = (
    "The plan leads the dish, so no way to a peak is shown. x begins anew with the best.",
    "The plan leads: no way to a peak. x begins anew with the best.",
    "The plan leads: no way to a peak.",
)
"""The same in fewer words."""
NONE_YET = "The strongest signal is kept here."


class ToPeakPane(Pane):
    """An arrow and degrees for each axis, what the peak was and when, and the keys that go there or forget it."""

    HELP = "The strongest signal since x: where it was, and how far that is from here."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "To the peak"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw both axes, the peak in words, and the keys."""
        level = view.level
        if followed_name(view):
            self._draw_pass(cells, view)
            return
        peak, fit = (None, None) if level is None else (level.peak, level.fit)
        turn = None if level is None else turn_to(level, view)
        across, up = (None, None) if turn is None else turn
        large = is_large(cells)
        y, wide = (5, 26) if large else (3, 16)
        self._axis(cells, 1, across, "◀", "▶", large=large)
        self._axis(cells, 1 + wide, up, "▼", "▲", large=large)
        cells.put(3, y, "azimuth", "dim")
        cells.put(3 + wide, y, "elevation", "dim")
        task = finding_now(view.state)
        if task is not None:
            cells.put(1, y + 1, cut(finding_words(task), cells.width - 2), "accent-strong")
        elif fit is not None:
            found = f"Fit of {fit.points}: {fit.az_deg:.2f}°/{fit.el_deg:.2f}° ±{fit.sigma_deg:.2f}°"
            cells.put(1, y + 1, cut(found, cells.width - 2), "text")
        elif peak is None:
            cells.put(1, y + 1, cut(NONE_YET, cells.width - 2), "dim")
        else:
            where = ""
            if peak.az_deg is not None and peak.el_deg is not None:
                where = f" at {peak.az_deg:.1f}°/{peak.el_deg:.1f}°"
            words = f"{value_text(peak.value, view.heard)} {view.heard.unit}{where}, {age_text(view.now - peak.at)} ago"
            cells.put(1, y + 1, cut(words, cells.width - 2), "text")
        if cells.height > y + 2:
            x = self.button(cells, 1, cells.height - 1, "signal-find", view, "Find …")
            x = self.button(cells, x, cells.height - 1, "signal-peak", view, "Go there …")
            self.button(cells, x, cells.height - 1, "signal-forget", view, "Forget")

    def _draw_pass(self, cells: Cells, view: View) -> None:
        """Say what counts while the plan leads the dish: the best since it follows, and what pointing costs."""
        width, level, pursuit = cells.width - 2, view.level, view.state.pursuit
        cells.put(1, 0, cut(f"Following {followed_name(view)}", width), "strong")
        best, peak = "--", None if level is None else level.peak
        if peak is not None:
            best = f"{value_text(peak.value, view.heard)} {view.heard.unit}, {age_text(view.now - peak.at)} ago"
        cells.put(1, 1, cut(f"best so far  {best}", width), "text")
        sample = None if pursuit is None else pursuit.sample
        if sample is not None:
            error, loss = f"{sample.error_deg:.2f}°", "" if sample.loss_db is None else f"{sample.loss_db:.1f} dB"
            words = f"pointing error  {error}" + (f", which costs {loss}" if loss else "")
            words = words if len(words) <= width else f"pointing error {error}, loss {loss}"
            cells.put(1, 2, cut(words, width), "text")
        rows = next(
            (rows for words in LED_BY_PLAN if len(rows := wrap(words, width)) <= cells.height - 4),
            [],
        )
        for y, line in enumerate(rows, 4):
            cells.put(1, y, line, "dim")

    @staticmethod
    def _axis(cells: Cells, x: int, turn_deg: float | None, less: str, more: str, *, large: bool) -> None:
        if turn_deg is None:
            put_big(cells, x + 2, 0, "-.--", "dim", large=large)
            return
        here = abs(turn_deg) < NEAR_DEG
        ink = "text" if here else "accent-strong"
        cells.put(x, 2 if large else 1, arrow(turn_deg, less, more), ink)
        text = f"{abs(turn_deg):.2f}" if abs(turn_deg) < 10.0 else f"{abs(turn_deg):.0f}"
        put_big(cells, x + 2, 0, f"{text}°", ink, large=large)
