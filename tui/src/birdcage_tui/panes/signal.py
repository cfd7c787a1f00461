"""The signal strip: what the source of the mounted feed heard, newest at the right."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

from birdcage.signal.source import SignalFacts
from birdcage.station.pursuit_state import Phase

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.drawing.strip_scale import strip_scale
from birdcage_tui.shown.level_words import db_text
from birdcage_tui.shown.markers import Marker
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import STALE_S, SignalSample, View
from birdcage_tui.widgets.pane import Pane

GAP = 1.2
"""A silence longer than the source's usual pause by so much is a gap, not a slope."""
SHARE = 22
"""Columns of the first row that the reading and its peak may take from who reads it, and for what."""
LEAST_NAME = 5
"""Columns below which a cut name says nothing."""
SPAN_S = 60.0
"""What the strip shows, whatever its width."""
ROUNDING = 1e-6
NOISES, STEPS = 20.0, 10.0
"""A scale shows so many standard deviations of the noise at least, and so many steps of the digits that are shown."""
SPANS = 20
"""Of these it takes one of so many in a decade: the noise is estimated anew with each reading, and the scale rests."""


class SignalPane(Pane):
    """Reading, peak and age in words; a braille curve below."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Signal"
        self._traced: tuple[object, Braille, SignalSample] | None = None
        """The curve of the frame before, what it was drawn by, and the reading that it ends with."""

    def draw(self, cells: Cells, view: View) -> None:
        """Draw words and curve, or what to do to hear something."""
        framed = self.gutter.top > 0
        title = f"Signal: {view.heard_by}, {view.heard_for}" if view.heard_for else "Signal"
        if self.border_title != title:  # setting it repaints the pane, equal or not
            self.border_title = title
        source = "" if framed and view.heard_for else owned_text(view, cells.width - SHARE)
        if not view.signal:
            self._empty(cells, view, source)
            return
        axis, (side, below) = self.axis(cells), self.spared(cells, view)
        width, height = max(cells.width - 2 - axis - side, 1), max(cells.height - 1 - below, 1)
        shown = [sample for sample in view.signal if view.now - sample.at <= SPAN_S]
        self.write_reading(cells, view, shown, source)
        if shown:
            span = self.span_words(view)
            if self.border_subtitle != span:  # setting it repaints the pane, equal or not
                self.border_subtitle = span
            self._curve(cells, shown, view, width, height, axis)

    @staticmethod
    def axis(cells: Cells) -> int:
        """Return how many columns the labels of the scale take."""
        return 6 if cells.width >= 34 and cells.height >= 4 else 0

    def spared(self, cells: Cells, view: View) -> tuple[int, int]:  # noqa: ARG002 - for others
        """Return columns at the right and rows beneath that are left for other things."""
        return 0, 0

    def span_words(self, view: View) -> str:  # noqa: ARG002 - for others
        """Return what is shown, for the frame."""
        return f"last {SPAN_S:.0f} s"

    def marked(self, view: View) -> Sequence[Marker]:  # noqa: ARG002 - for others
        """Return the moments that are marked on the curve."""
        return ()

    @staticmethod
    def write_reading(cells: Cells, view: View, shown: list[SignalSample], source: str) -> None:
        """Write reading, peak and where that was heard; at the right who hears, or how long ago that was."""
        last, heard = view.signal[-1], view.heard
        age_s = view.now - last.at
        old = _is_old(view)
        by = f"{age_text(age_s)} old" if old else source
        x = cells.put(1, 0, f"{_text(last.value, heard):>5}", "dim" if old else "strong")
        x = cells.put(x, 0, f" {heard.unit}", "dim")
        in_db = db_text(last.value, view)
        end = cells.width - 2 - len(by)
        x = cells.put(x, 0, f"  {in_db}" if in_db else "", "dim" if old else "text")
        if shown:
            best = max(shown, key=lambda sample: sample.value)
            parts = [(f"  peak {_text(best.value, heard)}", "text")]
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
        cells.right(cells.width - 1, 0, by, "warn" if age_s > heard.pause_s else "dim")

    def _curve(self, cells: Cells, shown: list[SignalSample], view: View, width: int, height: int, axis: int) -> None:
        heard, dots, last_x = view.heard, height * 4 - 1, width * 2 - 1
        # Time goes on by whole cells, so that most rows are as they were in the frame before.
        cell_s = 2.0 * SPAN_S / last_x
        now = math.ceil(view.now / cell_s) * cell_s
        values = [sample.value for sample in shown]
        scale = strip_scale(min(values), max(values), _least_span(view), heard.least, height)
        ink = "dim" if _is_old(view) else "accent"

        def column(at: float) -> float:
            return last_x * (1 - (now - at) / SPAN_S)

        ticks = {scale.dot(tick, dots): tick for tick in scale.ticks} if axis else {}
        for y, tick in ticks.items():
            cells.put(0, 1 + int(y) // 4, f"{tick:{axis}.{scale.decimals}f}", "dim")
        marked = [marker for marker in self.marked(view) if now - marker.at <= SPAN_S]
        drawn_by = now, scale, max(values), width, height, axis, ink, tuple(marker.at for marker in marked)
        known = self._traced
        if known is not None and known[0] == drawn_by and (first := _place_of(known[2], shown)) is not None:
            canvas, fresh = known[1], shown[first:]
        else:
            canvas, fresh = self._grid(width, height, tuple(ticks), scale.dot(max(values), dots)).copy(), shown
            for marker in marked:
                canvas.line(column(marker.at), 0, column(marker.at), dots, "dim", every=2)
        self._traced = drawn_by, canvas, shown[-1]
        # As `column` and `scale.dot` have it, for some five hundred readings; a value on a line stays on its row.
        left, per_s = column(0.0), last_x / SPAN_S
        top_y = scale.dot(0.0, dots) + ROUNDING
        per_unit = scale.dot(1.0, dots) - scale.dot(0.0, dots)
        for part in _without_gaps(fresh, GAP * heard.pause_s):
            canvas.trace([(left + sample.at * per_s, top_y + sample.value * per_unit) for sample in part], ink)
        canvas.onto(cells, 1 + axis, 1)
        for marker in marked:
            cells.put(1 + axis + int(column(marker.at)) // 2, 1, str(marker.number), "strong")

    @staticmethod
    @lru_cache(maxsize=4)
    def _grid(width: int, height: int, rows: tuple[float, ...], top: float) -> Braille:
        """Return the lines of the scale, and that of the highest reading: the same for many frames."""
        grid = Braille(width, height)
        for y in rows:
            grid.line(0, y, width * 2 - 1, y, "faint", every=8)
        grid.line(0, top, width * 2 - 1, top, "line", every=4)
        return grid

    @staticmethod
    def _empty(cells: Cells, view: View, source: str) -> None:
        top, ink = 0, "dim"
        if not view.heard.of_dish:
            cells.put(1, 0, f"{'--':>5} {view.heard.unit}", "dim")
            cells.right(cells.width - 1, 0, source, "dim")
            top, ink = 1, "warn" if view.signal_trouble else "dim"
        for row, line in enumerate(wrap(why_no_signal(view), max(cells.width - 2, 10)), top):
            cells.put(1, row, line, ink)


def _place_of(sample: SignalSample, shown: Sequence[SignalSample]) -> int | None:
    """Return where among the newest a reading is; None where it is none of them."""
    return next((at for at in range(len(shown) - 1, -1, -1) if shown[at] is sample), None)


def _without_gaps(shown: Sequence[SignalSample], longest_s: float) -> Iterator[Sequence[SignalSample]]:
    """Yield the parts of what was heard between which nothing was for longer than that."""
    begin = 0
    for index, (one, other) in enumerate(itertools.pairwise(shown), 1):
        if other.at - one.at > longest_s:
            yield shown[begin:index]
            begin = index
    yield shown[begin:]


def _is_old(view: View) -> bool:
    """Return whether the last reading is of before: long ago, or of a tuner that cannot be asked now."""
    return view.now - view.signal[-1].at > STALE_S or (view.heard.of_dish and not view.link_up)


def _least_span(view: View) -> float:
    """Return what the scale shows at least: so much that noise looks like noise, or what suits the source."""
    noise = None if view.level is None else view.level.noise
    if noise is None:
        return view.heard.span
    least = max(NOISES * noise, STEPS * 10.0**-view.heard.decimals)
    return float(10.0 ** (math.ceil(math.log10(least) * SPANS) / SPANS))


def why_no_signal(view: View) -> str:
    """Return why nothing was heard yet, in sentences."""
    if view.signal_trouble:
        return view.signal_trouble
    if not view.heard.of_dish:
        return "Connecting to the receiver."
    if not view.link_up:
        return "Nothing heard yet. The tuner reading starts once the dish answers."
    return "Nothing heard yet. The tuner is read while the dish rests."


def owned_text(view: View, width: int) -> str:
    """Return which source tells the signal, and for which target it is read where there is room to name one."""
    room = width - len(view.heard_by) - 2
    if not view.heard_for or room < LEAST_NAME:
        return view.heard_by
    return f"{view.heard_by}, {cut(view.heard_for, room)}"


def _text(value: float, heard: SignalFacts) -> str:
    return f"{value:.{heard.decimals}f}"


def _loss_db(view: View) -> float | None:
    """Return what pointing costs now; None while nothing is followed."""
    pursuit = view.state.pursuit
    if pursuit is None or pursuit.phase is not Phase.FOLLOWING or pursuit.sample is None:
        return None
    return pursuit.sample.loss_db
