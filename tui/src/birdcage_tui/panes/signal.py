"""The signal strip: what the receiver heard, or the dish's own tuner, newest at the right."""

from __future__ import annotations

import itertools

from birdcage.station.pursuit import Phase

from birdcage_tui.canvas import Braille, Cells
from birdcage_tui.cell_text import wrap
from birdcage_tui.pane import Pane
from birdcage_tui.view import STALE_S, TUNER, Sample, View
from birdcage_tui.words import age_text

LEAST_SPAN = {"counts": 100.0, "dB": 10.0}
"""Between the bottom and the top of the strip at least: noise must look like noise."""
SLOW_S = 8.5
"""The tuner is asked every 5 s, while the dish follows every 9 s in bursts: only what is older than this is amiss."""
SPAN_S = 60.0
"""What the strip shows, whatever its width."""


class SignalPane(Pane):
    """Reading, peak and age in words; a braille curve below."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Signal"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw words and curve, or what to do to hear something."""
        if not view.signal:
            self._empty(cells, view)
            return
        axis = 6 if cells.width >= 34 and cells.height >= 4 else 0
        width, height = max(cells.width - 2 - axis, 1), max(cells.height - 1, 1)
        shown = [sample for sample in view.signal if view.now - sample.at <= SPAN_S]
        self._words(cells, view, shown)
        if shown:
            span = f"last {SPAN_S:.0f} s"
            if self.border_subtitle != span:  # setting it repaints the pane, equal or not
                self.border_subtitle = span
            self._curve(cells, shown, view, width, height, axis)

    @staticmethod
    def _words(cells: Cells, view: View, shown: list[Sample]) -> None:
        """Write reading, peak and where that was heard; at the right who hears, or how long ago that was."""
        last, unit = view.signal[-1], view.heard.unit
        age_s = view.now - last.at
        old = _is_old(view)
        by = f"{age_text(age_s)} old" if old else view.heard.by
        x = cells.put(1, 0, f"{_text(last.value, unit):>5}", "dim" if old else "strong")
        x = cells.put(x, 0, f" {unit}", "dim")
        end = cells.width - 2 - len(by)
        if shown:
            best = max(shown, key=lambda sample: sample.value)
            parts = [(f"  peak {_text(best.value, unit)}", "text")]
            if best.az_deg is not None and best.el_deg is not None:
                parts.append((f" at {best.az_deg:.1f}°, {best.el_deg:.1f}°", "text"))
            parts.append((f", {age_text(view.now - best.at)} ago", "dim"))
            for part, ink in parts:
                if x + len(part) > end:
                    break
                x = cells.put(x, 0, part, ink)
        loss_db = _loss_db(view)
        if loss_db is not None and x + len(words := f"  pointing loss {loss_db:.1f} dB") <= end:
            cells.put(x, 0, words, "dim")
        cells.right(cells.width - 1, 0, by, "warn" if age_s > SLOW_S else "dim")

    @staticmethod
    def _curve(cells: Cells, shown: list[Sample], view: View, width: int, height: int, axis: int) -> None:
        now, least = view.now, LEAST_SPAN[view.heard.unit]
        low, high = min(s.value for s in shown), max(s.value for s in shown)
        spare = max(least - (high - low), (high - low) * 0.1)
        low, high = low - spare / 2, high + spare / 2
        if view.heard.unit == "counts":
            low = max(0.0, low)
        canvas, ink = Braille(width, height), "dim" if _is_old(view) else "accent"
        dots = height * 4 - 1

        def at(sample: Sample) -> tuple[float, float]:
            return (
                (width * 2 - 1) * (1 - (now - sample.at) / SPAN_S),
                dots * (1 - (sample.value - low) / (high - low)),
            )

        top = at(max(shown, key=lambda sample: sample.value))[1]
        canvas.line(0, top, width * 2 - 1, top, "line", every=4)
        for one, other in itertools.pairwise(shown):
            if other.at - one.at <= 5 * STALE_S:  # a longer silence is a gap, not a slope
                canvas.line(*at(one), *at(other), ink)
        canvas.dot(*at(shown[-1]), ink)
        if axis:
            cells.put(1, 1, f"{high:5.0f}", "dim")
            cells.put(1, height, f"{low:5.0f}", "dim")
        canvas.onto(cells, 1 + axis, 1)

    @staticmethod
    def _empty(cells: Cells, view: View) -> None:
        dish = view.state.dish
        if dish is not None and not dish.has_rssi:
            words = (f"The {dish.name} has no tuner to read.", "Use your own receiver for the signal.")
        elif not view.link_up:
            words = ("Nothing heard yet.", "The tuner reading starts once the dish answers.")
        else:
            words = ("Nothing heard yet.", "The tuner is read while the dish rests.")
        for row, line in enumerate(wrap(" ".join(words), max(cells.width - 2, 10))):
            cells.put(1, row, line, "dim")


def _is_old(view: View) -> bool:
    """Return whether the last reading is of before: long ago, or of a tuner that cannot be asked now."""
    return view.now - view.signal[-1].at > STALE_S or (view.heard.by == TUNER and not view.link_up)


def _text(value: float, unit: str) -> str:
    return f"{value:.0f}" if unit == "counts" else f"{value:.1f}"


def _loss_db(view: View) -> float | None:
    """Return what pointing costs now; None while nothing is followed."""
    pursuit = view.state.pursuit
    if pursuit is None or pursuit.phase is not Phase.FOLLOWING or pursuit.sample is None:
        return None
    return pursuit.sample.loss_db
