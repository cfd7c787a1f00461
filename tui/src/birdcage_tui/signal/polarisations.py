"""Both polarisations over time, as the dish's own tuner hears them in turn: only while a person has it so."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from birdcage.rotator.feature import EVEN_LEVEL, ODD_LEVEL

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.drawing.strip_scale import strip_scale
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.signal.receiver import SUPPLY, supply_text
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.pane import Pane

FEATURES = (EVEN_LEVEL, ODD_LEVEL)
SPAN_S = 300.0
LEAST_COUNTS = 50.0
"""What a scale shows at least, so that noise looks like noise."""
GAP_S = 30.0
"""A longer silence is a gap, not a slope."""
LATE_S = 12.0
"""They are heard about every five seconds."""


def polarisations_question(view: View) -> QuestionScreen:
    """Return the question before they are read: what each reading does."""
    features = {} if view.state.dish is None else view.state.dish.features
    hazard = features[EVEN_LEVEL].read_hazard if EVEN_LEVEL in features else ""
    now = supply_text(view.state.readings.get(SUPPLY)) or "not read yet"
    words = f"{hazard} They are read about every 5 s, until you show another view.\n\nSupply now: {now}."
    return QuestionScreen("Both polarisations", words, "read both")


class PolarisationPane(Pane):
    """One strip above the other, each on its own scale: their floors differ."""

    HELP = "Either polarisation. Each reading switches the supply of the LNB. v shows another view, and ends it."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Both polarisations, each reading switches the LNB supply"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw both."""
        reading = view.state.readings.get(SUPPLY)
        supply = supply_text(reading) if reading is not None and view.now - reading.at <= LATE_S else ""
        told = "   ".join(filter(None, [supply and f"LNB supply {supply}", f"last {SPAN_S / 60.0:.0f} min"]))
        if self.border_subtitle != told:  # setting it repaints the pane, equal or not
            self.border_subtitle = told
        dish = view.state.dish
        each = max(cells.height // len(FEATURES), 1)
        for index, name in enumerate(FEATURES):
            feature = None if dish is None else dish.features.get(name)
            label = name if feature is None else feature.label
            unit = "" if feature is None else feature.unit
            self._strip(cells, index * each, each, view, view.polarisations.get(name, ()), label, unit)

    @staticmethod
    def _strip(
        cells: Cells, y: int, rows: int, view: View, heard: Sequence[tuple[float, float]], label: str, unit: str
    ) -> None:
        """Draw one: value, unit and age in words, the curve below."""
        if not heard:
            cells.put(1, y, cut(f"    - {label}: not read yet", cells.width - 2), "dim")
            return
        at, value = heard[-1]
        late = view.now - at > LATE_S
        age = f"{age_text(view.now - at)} old"
        x = cells.put(1, y, f"{value:5.0f}", "dim" if late else "strong")
        x = cells.put(x, y, f" {unit}", "dim")
        cells.put(x + 2, y, cut(label, cells.width - x - len(age) - 5), "text")
        cells.right(cells.width - 1, y, age, "warn" if late else "dim")
        shown = [sample for sample in heard if view.now - sample[0] <= SPAN_S]
        if not shown or rows < 2:
            return
        axis = 6 if cells.width >= 34 and rows >= 3 else 0
        width, height = max(cells.width - 2 - axis, 1), rows - 1
        levels = [value for _at, value in shown]
        scale = strip_scale(min(levels), max(levels), LEAST_COUNTS, 0.0, height)
        canvas, ink = Braille(width, height), "dim" if late else "accent"

        def place(sample: tuple[float, float]) -> tuple[float, float]:
            return (
                (width * 2 - 1) * (1.0 - (view.now - sample[0]) / SPAN_S),
                scale.dot(sample[1], height * 4 - 1),
            )

        for tick in scale.ticks if axis else ():
            tick_y = scale.dot(tick, height * 4 - 1)
            canvas.line(0, tick_y, width * 2 - 1, tick_y, "faint", every=8)
            cells.put(1, y + 1 + int(tick_y) // 4, f"{tick:5.{scale.decimals}f}", "dim")
        for one, other in itertools.pairwise(shown):
            if other[0] - one[0] <= GAP_S:
                canvas.line(*place(one), *place(other), ink)
        canvas.dot(*place(shown[-1]), ink)
        canvas.onto(cells, 1 + axis, y + 1)
