"""What is pointed at: the object, where it should be, where the dish is, and the keys that bring both together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from birdcage.base.geometry import shortest_turn

from birdcage_tui.calibrate.calibrate_words import aside, direction, put_wrapped
from birdcage_tui.calibrate.lists import ObjectsPane
from birdcage_tui.commands.mending import motion_mend
from birdcage_tui.commands.signal import deaf
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.calibration.guide import GuideView

    from birdcage_tui.shown.calibration import CalibrateNow

LABEL = 12
HEARD_S = 30.0
"""The highest signal is that of so long."""
FOR_BUTTONS = 54
"""Columns from which each button has all of its words."""
HERE_DEG = 0.03
"""Nearer than this is here: the gears step in as much."""
ARROWS = (("calibrate-left", "←"), ("calibrate-right", "→"), ("calibrate-up", "↑"), ("calibrate-down", "↓"))
WAIT = "Opening the guide. It finds what is up."


class AimPane(Pane, can_focus=True):
    """Expected and read directions, how far it was nudged, what is heard; buttons below."""

    HELP = (
        "n selects the next object, Enter goes there. f finds its peak by the signal and saves it. By hand: nudge "
        "until the signal is highest, then press Enter. Steps are degrees on the sky. The dish uses the peaks so "
        "far, so each next object starts nearer."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Peak on"
        self._on: object = None
        self._since = float("-inf")
        """When the object was another one last, or the alignment in force."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows; the buttons stand in the last ones."""
        now = view.calibrate
        guide = None if now is None else now.guide
        if now is None or guide is None:
            words = now.wrong if now is not None and now.wrong else WAIT
            put_wrapped(cells, 0, words, "warn" if now is not None and now.wrong else "dim")
            return
        on = guide.target, view.state.alignment
        if on != self._on:
            self._on, self._since = on, view.now
        buttons = cells.height - 2
        y = self._target(cells, view, guide, now) if guide.target else self._none(cells, now, guide)
        self._words(cells, y, buttons, now, guide, view)
        if guide.target:
            x = 1
            for command, sign in ARROWS:
                x = self._arrow(cells, x, buttons, command, sign)
            x = cells.put(x + 1, buttons, f"{view.step_deg:g}°", "strong") + 1
            for command, sign in (("step-down", "-"), ("step-up", "+")):
                x = self._arrow(cells, x, buttons, command, sign)
            if cells.width >= x + 26:
                self.button(cells, x + 2, buttons, "calibrate-again", view)
        x = 1
        if guide.target and ObjectsPane.scope not in view.scopes:
            peak = deaf(view) is None
            narrow = peak and cells.width < FOR_BUTTONS
            if peak:
                x = self.button(cells, x, buttons + 1, "calibrate-find", view, "find" if narrow else "find the peak")
            x = self.button(cells, x, buttons + 1, "calibrate-take", view, "save" if narrow else "save peak")
        if ObjectsPane.scope in view.scopes:
            self.button(cells, x, buttons + 1, "calibrate-object-go", view, "go there")
        else:
            self.button(cells, x, buttons + 1, "calibrate-next", view, "next object")

    def _arrow(self, cells: Cells, x: int, y: int, command: str, sign: str) -> int:
        cells.put(x, y, f" {sign} ", "key")
        self.heat(x, y, 3, command)
        return x + 4

    @staticmethod
    def _none(cells: Cells, now: CalibrateNow, guide: GuideView) -> int:
        if not guide.proposals:
            if now.wrong:
                return 0
            return put_wrapped(
                cells, 0, "Finding what is up …" if now.searching else "No object to peak on now.", "dim"
            )
        best = guide.proposals[0]
        cells.put(1, 0, f"Next best: {best.candidate.name}", "target-strong")
        return put_wrapped(cells, 1, best.words() + ".", "text", rows=3)

    def _target(self, cells: Cells, view: View, guide: GuideView, now: CalibrateNow) -> int:
        cells.put(1, 0, guide.target, "target-strong")
        state = guide.busy or ("" if now.guide is None or guide.may_not_take else "at rest")
        if cell_len(guide.target) + len(state) + 3 <= cells.width:
            cells.right(cells.width - 1, 0, state, "accent" if guide.busy else "dim")
        stands = "--" if guide.expected is None else direction(*guide.expected)
        position = guide.position
        reads = "--" if position is None else direction(position.dish_az_deg, position.dish_el_deg)
        rows = [("object at", "target", stands + "  true"), ("dish reads", "text", reads + "  dish frame")]
        if guide.busy.startswith("going"):
            rows.append(("to go", "accent", "--" if guide.nudged is None else f"{math.hypot(*guide.nudged):.1f}°"))
        else:
            rows.append(("nudged", "accent", "--" if guide.nudged is None else aside(*guide.nudged)))
        rows.append(("signal", "text", _signal(view, self._since, cells.width - LABEL - 2)))
        for y, (label, ink, words) in enumerate(rows, 1):
            cells.put(1, y, label, "dim")
            cells.put(1 + LABEL, y, cut(words, cells.width - LABEL - 1), "dim" if words in ("--", "waiting") else ink)
        return 1 + len(rows)

    @staticmethod
    def _words(cells: Cells, y: int, end: int, now: CalibrateNow, guide: GuideView, view: View) -> None:
        """Say what is wrong, else what was done, else what to do."""
        if now.wrong:
            ink, words = "warn", f"▲ {now.wrong}"
        elif now.told:
            ink, words = "good", now.told
        elif ObjectsPane.scope in view.scopes:
            ink, words = "dim", "Enter goes to the selected object."
        elif guide.target and not guide.busy and not view.moving:
            first = motion_mend(view)
            ink, words = "dim", guide.may_not_take or _how(view)
            words = words if first is None else f"{first.sentence}."
        else:
            return
        if y + 1 < end and cells.height >= 10:
            y += 1
        put_wrapped(cells, y, words, ink, rows=end - y)


def _how(view: View) -> str:
    """Say how the peak is found: by the signal, or by hand where nothing can be heard, and why."""
    reason = deaf(view)
    if reason is None and view.heard.of_dish:
        return "f finds the peak by the signal, and saves it."
    if reason is None and not view.signal_trouble:
        return f"f finds the peak by the {view.heard.label}, and saves it."
    return f"{reason or view.signal_trouble} Nudge to the highest signal, then press Enter."


def _signal(view: View, since: float, width: int) -> str:
    """Return what is heard, and where it was highest lately; without a tuner, the person's meter tells.

    What was heard before `since` counts for nothing: on another object, or with directions that were others.
    """
    recent = [sample for sample in view.signal if sample.at >= max(since, view.now - HEARD_S)]
    if not recent:
        return "use your own meter" if view.signal_trouble else "waiting"
    unit, digits = view.heard.unit, view.heard.decimals
    best = max(recent, key=lambda sample: sample.value)
    last, most = f"{recent[-1].value:.{digits}f}", f"{best.value:.{digits}f}"
    words = f"{last} {unit}, max {most}"
    here = view.state.position
    if here is None or best.az_deg is None or best.el_deg is None:
        return words
    right = shortest_turn(here.az_deg, best.az_deg) * math.cos(math.radians(here.el_deg))
    up = best.el_deg - here.el_deg
    if math.hypot(right, up) < HERE_DEG:
        return f"{words} here"
    told = (f"{words}, {aside(right, up)} of here", f"{last}, {most} {aside(right, up)}")
    return next((each for each in told if len(each) <= width), words)
