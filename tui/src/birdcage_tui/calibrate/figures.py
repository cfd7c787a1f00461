"""How good the fit is, and what came out of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.calibrate.calibrate_words import ENOUGH, TERMS, figure_rows, fitted_words, put_wrapped
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.calibration.fit import Fit

    from birdcage_tui.shown.calibration import CalibrateNow

LABEL = 11
TERMS_WIDTH = 36
SHORT_ROWS, SHORT = 3, 7
"""With fewer rows the figures stand in three, so that there is room for the warning."""
BESIDE = 84
"""From this width on the terms stand beside the figures."""


def said_below(now: CalibrateNow | None) -> tuple[str, ...] | None:
    """Return the sentence below the figures, if there is one; None where there are no figures."""
    if now is None or now.guide is None or now.guide.fit is None:
        return None
    warning = now.guide.fit.warning
    return (f"▲ {warning}",) if warning else (ENOUGH,) if now.enough else ()


def rows_needed(said: tuple[str, ...] | None, width: int) -> int:
    """Return how many rows, frame included, the figures take with what is said below them; 0 where there are none."""
    return 0 if said is None else max(SHORT_ROWS + 2 + sum(len(wrap(words, width - 4)) for words in said), SHORT)


class FiguresPane(Pane):
    """Errors before, after and left out, the condition in words, the warning; where there is room, the terms."""

    HELP = (
        "RMS: pointing error at these peaks, before with the alignment in use, after with the fit. Left out: error "
        "of each peak with a fit to the others. Whole sky: expected error over all that this dish reaches. Condition: "
        "low means that the peaks are spread well enough to tell the terms apart."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "The fit"

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows, the warning below; dashes where nothing is known."""
        now = view.calibrate
        guide = None if now is None else now.guide
        if now is None or guide is None or guide.fit is None:
            return  # it is not seen then
        fit = guide.fit
        beside = cells.width >= BESIDE
        width = cells.width - TERMS_WIDTH - 3 if beside else cells.width - 2
        y = 0
        short = cells.height < SHORT or cells.width < LABEL + 34
        told = fitted_words(fit) if short else ""
        if told != (self.border_subtitle or ""):  # setting it repaints the pane, equal or not
            self.border_subtitle = told
        for label, ink, words in figure_rows(guide, short=short):
            cells.put(1, y, label, "dim")
            cells.put(1 + LABEL, y, words[: width - LABEL], ink)
            y += 1
        if beside:
            self._terms(cells, fit, cells.width - TERMS_WIDTH, 0)
        elif cells.height >= y + len(TERMS) + 4:
            self._terms(cells, fit, 1, y + 1)
            y += len(TERMS) + 1
        for words in said_below(now) or ():
            air = y + len(wrap(words, width)) < cells.height
            put_wrapped(cells, y + air, words, "warn" if fit.warning else "good", width=width)

    @staticmethod
    def _terms(cells: Cells, fit: Fit, x: int, y: int) -> None:
        for row, ((term, meaning), error) in enumerate(zip(TERMS, fit.errors_deg, strict=True)):
            cells.put(x, y + row, meaning, "dim")
            held = error is None
            cells.put(x + 18, y + row, f"{getattr(fit.alignment, term):+7.2f}°", "dim" if held else "text")
            cells.put(x + 28, y + row, "held" if error is None else f"±{error:.2f}°", "dim")
