"""The three lists: objects to peak on, peaks that were taken, sets that were kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from textual import events

from birdcage_tui.calibrate.calibrate_words import maybe, put_wrapped
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, pad, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.calibration.guide import GuideView

    from birdcage_tui.shown.calibration import CalibrateNow, KeptSet


DIRECTION_FROM = 48
"""Columns of a row from which there is room for where the object of a peak stood."""
HEADED = 3
"""Rows from which the columns have names above them."""
OFFSETS_FROM = 36
"""Columns of a row from which there is room for the offsets of a set."""


class ListPane(Pane):
    """Rows with a cursor; a click chooses. What a row means is the subclass's."""

    TITLE = EMPTY = NOUN = ""
    scope = ""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = self.TITLE
        self.at = 0
        """The row of the cursor."""
        self._top = 0
        self._headed = 0
        """Rows of the names of the columns."""

    def rows(self, now: CalibrateNow) -> list[tuple[str, str]]:
        """Return ink and words of each row."""
        raise NotImplementedError

    def empty(self, now: CalibrateNow) -> str:
        """Return what stands where there is no row."""
        return "" if now.searching else self.EMPTY

    def head(self) -> str:
        """Return the names of the columns, above their right ends."""
        raise NotImplementedError

    def foot(self, now: CalibrateNow) -> str:  # noqa: ARG002 - not every list has one
        """Return a sentence about the chosen row, where there is room."""
        return ""

    def width(self) -> int:
        """Return the columns of a row."""
        return max(self.size.width - 4, 10)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows around the cursor."""
        now = view.calibrate
        rows = [] if now is None or now.guide is None else self.rows(now)
        told = f"{len(rows)} {self.NOUN}{'' if len(rows) == 1 else 's'}" if rows else ""
        if told != (self.border_subtitle or ""):
            self.border_subtitle = told
        if now is None or not rows:
            put_wrapped(cells, 0, "" if now is None else self.empty(now), "dim")
            return
        self.at = min(max(self.at, 0), len(rows) - 1)
        self._headed = int(cells.height >= HEADED)
        if self._headed:
            cells.put(0, 0, f"   {self.head()}", "dim")
        foot = wrap(self.foot(now), max(cells.width - 2, 10)) if cells.height >= 6 else []
        room = cells.height - self._headed - len(foot)
        self._top = max(min(self._top, self.at, len(rows) - room), self.at - room + 1, 0)
        for y, (ink, words) in enumerate(rows[self._top : self._top + room], self._headed):
            here = self._top + y - self._headed == self.at
            row = f" {'▶' if here and self.has_focus else '›' if here else ' '} {words}"
            cells.put(0, y, pad(row, cells.width), ("key" if self.has_focus else "strong") if here else ink)
        for y, words in enumerate(foot, cells.height - len(foot)):
            cells.put(1, y, words, "dim")

    def move(self, by: int) -> None:
        """Move the cursor."""
        self.at = max(self.at + by, 0)
        cast(AppHost, self.app).paint()

    def on_focus(self) -> None:
        """Show the cursor."""
        cast(AppHost, self.app).paint()

    def on_click(self, event: events.Click) -> None:
        """Choose the row under the mouse."""
        offset = event.get_content_offset(self)
        if offset is not None:
            event.stop()
            self.at = self._top + max(offset.y - self._headed, 0)
            cast(AppHost, self.app).paint()

    def do(self, command: str) -> bool:
        """Move the cursor; the rest is the page's."""
        if command.endswith(("-up", "-down")):
            self.move(1 if command.endswith("-down") else -1)
            return True
        return False


class ObjectsPane(ListPane, can_focus=True):
    """What is up and in reach, best first, and what the error over the sky would be after a peak on it.

    The current object is always among them.
    """

    TITLE, NOUN = "Objects: sky error after a peak", "object"
    EMPTY = "This dish can hear nothing that is in reach now. r: look again."
    HELP = (
        "Objects that you can peak on now, the best first. The last column is the error to expect over the sky after "
        "that peak. Objects beside a saved peak are left out; the current one stays, at the end. Enter goes there."
    )
    scope = "calibrate-objects"

    def empty(self, now: CalibrateNow) -> str:
        """Say nothing of what is up where that could not be found out: *Peak on* says why."""
        return "" if now.wrong else super().empty(now)

    def rows(self, now: CalibrateNow) -> list[tuple[str, str]]:
        """Name, direction, and the error then."""
        assert now.guide is not None
        name = self._name_width()
        found = [(each.candidate, error_text(each.error_then_deg)) for each in now.guide.proposals]
        rows = [
            ("text", f"{pad(cut(one.name, name), name)} {one.az_deg:4.0f}° {one.el_deg:2.0f}° {then:>6}")
            for one, then in found
        ]
        if present_row(now.guide) == len(rows):
            stands = now.guide.expected
            where = f"{'--':>5} {'--':>3}" if stands is None else f"{stands[0]:4.0f}° {stands[1]:2.0f}°"
            rows.append(("target", f"{pad(cut(now.guide.target, name), name)} {where} {'here':>6}"))
        return rows

    def _name_width(self) -> int:
        return max(self.width() - 20, 8)

    def head(self) -> str:
        """Name the columns."""
        return f"{'':{self._name_width()}}   az  el   error"

    def foot(self, now: CalibrateNow) -> str:
        """Say what is known without the chosen one, and how well it can be found."""
        assert now.guide is not None
        chosen = now.guide.proposals[self.at : self.at + 1]
        if not chosen:
            return "The current object. Enter returns to where it is now."
        one = chosen[0]
        rise = "" if one.candidate.rise_db is None else f", {one.candidate.rise_db:.1f} dB over the sky"
        return f"Sky error now {error_text(one.error_now_deg)}. Peak to ±{one.candidate.sigma_deg:.2f}°{rise}."


def present_row(guide: GuideView) -> int | None:
    """Return the row of the current object: its own among the proposals, else the one after them; None without one."""
    if not guide.target:
        return None
    names = [each.candidate.name for each in guide.proposals]
    return names.index(guide.target) if guide.target in names else len(names)


class PeaksPane(ListPane, can_focus=True):
    """Peaks with what is left of each, and what the others alone say of it."""

    TITLE, NOUN = "Peaks", "peak"
    EMPTY = "No peaks yet. Each peak is saved at once."
    HELP = (
        "Saved peaks: direction of the object, error left by the fit, and error left by a fit to the others (left "
        "out). d deletes a peak, u restores it. After you move the base press X to start anew."
    )
    scope = "calibrate-peaks"

    def rows(self, now: CalibrateNow) -> list[tuple[str, str]]:
        """Number, name, direction, what is left, what is left by the others."""
        guide = now.guide
        assert guide is not None
        return [self._row(guide, index, self.width()) for index in range(len(guide.peaks))]

    def head(self) -> str:
        """Name the columns."""
        where = "   az  el " if self.width() >= DIRECTION_FROM else ""
        return f"{where}  error left out".rjust(self.width() - 1)

    @staticmethod
    def _row(guide: GuideView, index: int, width: int) -> tuple[str, str]:
        peak, fit = guide.peaks[index], guide.fit
        left = alone = None
        if fit is not None and index < len(fit.residuals):
            each = fit.residuals[index]
            left = each.off_deg
            if each.alone_right_deg is not None and each.alone_up_deg is not None:
                alone = (each.alone_right_deg**2 + each.alone_up_deg**2) ** 0.5
        where = f" {peak.true_az_deg:4.0f}° {peak.true_el_deg:2.0f}°" if width >= DIRECTION_FROM else ""
        last = f"{where} {maybe(left):>6} {maybe(alone):>8}"
        name = max(width - len(last) - 4, 6)
        odd = fit is not None and fit.warning.startswith(f"Peak {peak.number} ")
        return "warn" if odd else "text", f"{peak.number:>2} {pad(cut(peak.target, name), name)}{last}"

    def foot(self, now: CalibrateNow) -> str:
        """Say when and how the chosen one was found."""
        assert now.guide is not None
        chosen = now.guide.peaks[self.at : self.at + 1]
        if not chosen:
            return ""
        peak = chosen[0]
        dish = f"dish {peak.dish_az_deg:.2f}° {peak.dish_el_deg:.2f}°"
        return f"{peak.utc:%d %b %H:%MZ}, {dish}, ±{peak.sigma_deg:.2f}°."


class SetsPane(ListPane, can_focus=True):
    """Alignments with names, the one in force marked."""

    TITLE, NOUN = "Sets", "set"
    EMPTY = "No saved sets. Press a to save the fit under a name, one for each setup of the dish."
    HELP = "Saved alignments. Enter uses the one under the cursor. Nothing moves."
    scope = "calibrate-sets"

    def rows(self, now: CalibrateNow) -> list[tuple[str, str]]:
        """Name, whether in force, its offsets, and how good it was."""
        return [self._row(each, self.width()) for each in now.sets]

    def head(self) -> str:
        """Name the columns."""
        offsets = "az offset el offset" if self.width() >= OFFSETS_FROM else ""
        return f"{offsets}    RMS".rjust(self.width() - 1)

    @staticmethod
    def _row(kept: KeptSet, width: int) -> tuple[str, str]:
        entry = kept.entry
        offsets = f" {entry.az_offset_deg:+8.2f}° {entry.el_offset_deg:+8.2f}°" if width >= OFFSETS_FROM else ""
        last = f"{offsets} {maybe(entry.rms_deg):>6}"
        name = max(width - len(last) - 3, 6)
        sign = "●" if kept.in_force else " "
        return "good" if kept.in_force else "text", f"{sign} {pad(cut(entry.name, name), name)}{last}"


def error_text(value: float) -> str:
    """Return an error in a column of six."""
    return f"{value:.2f}°" if value < 10.0 else f"{value:.0f}°"
