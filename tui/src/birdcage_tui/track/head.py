"""The first rows of the Craft tab: the target, its pass, its reach, the error to expect; the selector."""

from __future__ import annotations

from birdcage.pursuit.now import Mode

from birdcage_tui.commands import BY_NAME
from birdcage_tui.commands.mending import motion_mend, release_mend, then_words
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, fit, wrap
from birdcage_tui.shown.pursuit import LOADING, plan_of, pursuit_of, shown_is_followed
from birdcage_tui.shown.track_words import expected_words, offset_words, pass_words, reach_words
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

SELECTOR = (("track-watch", Mode.WATCH, "Watch"), ("track-aim", Mode.AIM, "Aim once"),
            ("track-follow", Mode.FOLLOW, "Follow"))  # fmt: skip
NO_TARGET = "No target selected. Enter selects the row under the cursor; / searches."

FIND = "/ finds names, numbers and slots (19.2E)."
HOW = f"Then f and Enter follow it. {FIND}"


class TrackHead(Pane):
    """Four rows: who and when, what of it is in reach, how sure that is, and what is done with it."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        plan = plan_of(view)
        if plan is None:
            self._without_plan(cells, view)
        else:
            words = pass_words(plan)
            number = f"  {plan.aim.norad_id}" if plan.aim.norad_id else ""
            room = cells.width - len(words) - 4
            name = plan.aim.name if cell_len(plan.aim.name) + len(number) > room else plan.aim.name + number
            x = cells.put(1, 0, fit(name, max(room, 8)), "target-strong")
            cells.put(x + 2, 0, words, "text")
            ink, shapes = expected_words(plan)
            beside = cells.height < 4 and bool(shapes)
            room = cells.width - 2 - (len(shapes[-1]) + 3 if beside else 0)
            x = cells.put(
                1, 1, reach_words(plan, room, view.utc.timestamp()), "text" if plan.reach.intervals else "warn"
            )
            x, y = (x + 3, 1) if beside else (1, 2)
            if cells.height >= 4 or beside:
                cells.put(x, y, next((each for each in shapes if x + len(each) < cells.width), ""), ink)
        self._selector(cells, cells.height - 1, view)

    @staticmethod
    def _without_plan(cells: Cells, view: View) -> None:
        """Say what to do first."""
        chosen = None if view.track is None else view.track.choice
        if view.settings.place is None:
            cells.put(1, 0, NO_LOCATION, "warn")
        elif view.track is None or view.track.is_away:
            why = LOADING if view.track is None else view.track.problem
            for y, row in enumerate(wrap(why, max(cells.width - 2, 10), most=2)):
                cells.put(1, y, row, "dim")
        elif chosen is not None:
            cells.put(1, 0, f"{chosen}: computing the pass …", "text")
        else:
            first = release_mend(view)
            cells.put(
                1, 0, NO_TARGET if first is None else f"No target selected. {first.sentence}; / searches.", "text"
            )
            follow = then_words(view, "f and Enter follow a target")
            cells.put(1, 1, HOW if motion_mend(view) is None else f"{follow} {FIND}", "dim")

    def _selector(self, cells: Cells, y: int, view: View) -> None:
        desk, pursuit = view.track, pursuit_of(view.state)
        mode = Mode.WATCH if desk is None else desk.mode
        if pursuit is not None:
            mode = Mode.FOLLOW if plan_of(view) is None or shown_is_followed(view) else Mode.WATCH
        x = 1
        for name, which, words in SELECTOR:
            known = BY_NAME[name]
            here = which is mode and (pursuit is not None or (desk is not None and desk.choice is not None))
            text = f" {'●' if here else '○'} {known.shown} {words} "
            dim = known.refused(view) is not None
            start = x
            x = cells.put(x, y, text, "accent-row" if here else "bar-dim" if dim else "bar")
            self.heat(start, y, x - start, name)
        x = self.button(cells, x + 1, y, "track-leave", view, "leave")
        x = self.button(cells, x, y, "track-search", view, "search")
        words = offset_words(view)
        if desk is not None and desk.choice is not None:
            if x + 9 + len(words) > cells.width:
                words = words.partition(" = ")[0]
            for command in ("track-earlier", "track-later"):
                start = x
                x = cells.put(x, y, f" {BY_NAME[command].shown} ", "key")
                self.heat(start, y, x - start, command)
            cells.put(x + 1, y, words, "target" if desk.aim is not None and desk.aim.time_offset_s else "dim")
