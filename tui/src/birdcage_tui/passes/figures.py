"""What else one wants to know of the chosen pass: range, Doppler, Sun, and what an error of the clock costs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.gps.verdict import cost_deg
from birdcage.sky.doppler import doppler_hz

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.sky_picture import DopplerFrequency, ShownPass
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.base.beam import Beam

PER = DopplerFrequency(100e6, "no downlink known")
"""Without a downlink and a band Doppler is told per 100 MHz: it grows as the frequency does."""
SUN_RADIUS_DEG = 0.27


class PassFigures(Pane):
    """A row for each of AOS, TCA and LOS, one for the moment shown, then the Sun and the clock."""

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Figures"
        self._selection = selection

    def draw(self, cells: Cells, view: View) -> None:
        """Write the table."""
        row, t_s = self._selection.chosen(view), self._selection.time(view)
        if row is None:
            cells.put(1, 0, "No pass selected.", "dim")
            return
        title = f"Figures  Doppler at {frequency_words(frequency_of(row))}"
        if title != self.border_title:
            self.border_title = title
        cells.put(1, 0, f"     {'time':<8}{'azimuth':>10}{'range':>11}{'Doppler':>13}", "dim")
        lines = [(words, at_s) for words, at_s in
                 (("AOS", row.aos_s), ("TCA", row.tca_s), ("LOS", row.los_s))]  # fmt: skip
        below = [*packed(signal_lines(row), cells.width - 2), *clock_lines(row)]
        below += _joined(sun_lines(row, view.state.beam))
        moment = "now" if self._selection.machine.is_now else "then"
        if row.aos_s <= t_s <= row.los_s and cells.height >= len(lines) + len(below) + 2:
            lines.append((moment, t_s))
        y = 1
        for words, at_s in lines:
            cells.put(1, y, f"{words:<4} {self._line(row, words, at_s)}", "target" if words == moment else "text")
            y += 1
        for ink, words in below[: cells.height - y]:
            cells.put(1, y, words, ink)
            y += 1

    @staticmethod
    def _line(row: ShownPass, words: str, at_s: float) -> str:
        if (words == "AOS" and row.already_up) or (words == "LOS" and row.still_up):
            return "already up" if words == "AOS" else "after the search ends"
        place = row.path.at(at_s)
        range_text, doppler = away(row, at_s)
        azimuth = "--" if place is None else f"{place[0]:.1f}°"
        return f"{clock_text(at_s)}{azimuth:>10}{range_text:>11}{doppler:>13}"


def frequency_of(row: ShownPass) -> DopplerFrequency:
    """Return the frequency that Doppler is told for."""
    return row.tuned() or PER


def frequency_words(frequency: DopplerFrequency) -> str:
    """Return `137.9 MHz, its LRPT`."""
    return f"{frequency.hz / 1e6:.10g} MHz, {frequency.what}"


def doppler_at(row: ShownPass) -> str:
    """Return the same, without what the line of what is sent says already."""
    frequency = frequency_of(row)
    number = f"{frequency.hz / 1e6:.10g} MHz"
    told = f"{number} {frequency.what.removeprefix('its ')}"
    return number if row.hears and row.hears.startswith(told) else frequency_words(frequency)


def away(row: ShownPass, at_s: float) -> tuple[str, str]:
    """Return range and Doppler at a time, with units; dashes where they are not known."""
    found = row.path.distance(at_s)
    if found is None:
        return "--", "--"
    return f"{found[0]:.0f} km", f"{_kilohertz(doppler_hz(frequency_of(row).hz, found[1]))} kHz"


def _kilohertz(shift_hz: float) -> str:
    digits = 1 if abs(shift_hz) >= 1e5 else 2
    return f"{round(shift_hz / 1e3, digits) or 0.0:+.{digits}f}"  # never -0.00


def clock_lines(row: ShownPass) -> list[tuple[str, str]]:
    """Return (ink, words) of what a second costs where the pass is fastest."""
    rate = row.path.fastest_deg_s()
    if rate is None:
        return []
    return [("text", f"1 s of clock error costs {cost_deg(1.0, rate):.2g}°")]


def sun_lines(row: ShownPass, beam: Beam | None) -> list[tuple[str, str]]:
    """Return (ink, words) of whether the Sun shines on it, and whether it passes before the Sun."""
    share, sun = row.found.sunlit_share, row.found.sun
    lit = "Sun-lit" if share > 0.99 else "in shadow" if share < 0.01 else f"Sun-lit {share:.0%} of it"
    if sun is None:
        return [("text", f"{lit}, Sun down")]
    at_s, apart_deg = sun.at.timestamp(), sun.separation_deg
    crosses = apart_deg <= SUN_RADIUS_DEG + (0.0 if beam is None else max(beam.az_deg, beam.el_deg) / 2.0)
    told = ("warn", f"▲ Sun in the beam {clock_text(at_s)}") if crosses else (
        "text", f"Sun {apart_deg:.0f}° off at {clock_text(at_s, seconds=False)}")  # fmt: skip
    return [("text", lit), told]


def signal_lines(row: ShownPass) -> list[tuple[str, str]]:
    """Return (ink, words) of what is sent, SatDump's name for it, and how sure that is."""
    frequency = frequency_of(row)
    return [
        ("warn" if words.startswith("doubtful") else "text", words)
        for words in frequency.signal
        if words != frequency.what.removeprefix("its ")  # that stands beside the frequency
    ]


def packed(lines: list[tuple[str, str]], width: int) -> list[tuple[str, str]]:
    """Return (ink, words) side by side as far as there is room, none cut in two; each line in the ink of its last."""
    found: list[tuple[str, str]] = []
    for ink, words in lines:
        longer = f"{found[-1][1]}  {words}" if found else words
        if found and len(longer) <= width:
            found[-1] = (ink, longer)
        else:
            found.append((ink, words))
    return found


def _joined(lines: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return lines as one, in the ink of the last."""
    return [(lines[-1][0], ", ".join(words for _, words in lines))] if lines else []
