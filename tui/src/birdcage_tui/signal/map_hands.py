"""What the keys of the map do on the signal page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.skymap.map_file import MapHead
from birdcage.skymap.map_request import KIND, MapRequest, again
from birdcage.skymap.plan import MapFrame
from birdcage.station.requests import BeginTask, EndMotion

from birdcage_tui.shown.map_book import map_task
from birdcage_tui.shown.map_words import clock_words
from birdcage_tui.shown.view import YOU
from birdcage_tui.signal.ask_map import estimated, map_question, request_of, target_path
from birdcage_tui.signal.map_inks import NIGHT, next_colours
from birdcage_tui.signal.map_list import maps_question, title_of
from birdcage_tui.signal.map_teach import MapTeach
from birdcage_tui.signal.map_work import NO_MAP, MapWork
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import Values

if TYPE_CHECKING:
    from birdcage.station.state import StopReport

    from birdcage_tui.widgets.page import Page

TargetPath = tuple[str, tuple[tuple[float, ...], ...]]
"""A target's name, and rows of POSIX seconds, azimuth and elevation."""
SPARE, SPARE_S = 1.5, 3600.0
"""So much longer than the estimate the way of a target is known; then the map pauses, and u finds it anew."""
CLEAR = "Keep its swing clear."
PAUSED = "Map paused. u resumes it, even after a restart."
STOPPED = "STOP came first. No map was begun."


class MapHands(MapWork):
    """Begins, ends, opens and looks at maps; `page` is where they are seen."""

    def __init__(self, page: Page, show: Callable[[], object], switch: Callable[[], object]) -> None:
        """`show`: shows the map on the page; `switch`: gives it the page alone, or takes that back."""
        super().__init__(page)
        self._show, self._switch = show, switch
        self._begun = 0
        self._teach = MapTeach(page, show)

    def has_begun(self) -> bool:
        """Return whether a map has begun since this was asked last."""
        before, self._begun = self._begun, self._host.maps.book.begun
        return self._begun > before

    def do(self, command: str) -> bool:
        """Carry out a command; False for one that is none of the map's."""
        match command:
            case "map-begin":
                self._page.app.push_screen(map_question(self._host.view), self._begin)
            case "map-resume":
                self._resume()
            case "map-list":
                self._host.maps.list(self._choose)
            case "map-pause":
                self._pause()
            case "map-enter":
                self._enter()
            case "map-whole":
                self._switch()
            case "map-colours":
                self._recolour()
            case "map-cuts":
                self._cut()
            case "map-goto":
                self._point()
            case "map-lessons":
                self._show()
                self._teach.ask()
            case "map-offer-keep":
                self._teach.keep_horizon()
            case "map-offer-leave":
                self._pane.withdraw()
            case _:
                return False
        return True

    def _begin(self, values: Values | None) -> None:
        """Begin what was typed, once it is known where its target will be."""
        if values is None:
            return
        view = self._host.view()
        try:
            request = request_of(view, values)
        except ValueError as wrong:  # time has passed since it was typed
            self._host.say(str(wrong))
            return
        self._send(request, estimated(view, request).seconds, "The map begins")

    def _send(self, request: MapRequest, lasts_s: float, words: str) -> None:
        view = self._host.view()
        place = view.settings.place
        if request.plan.frame is not MapFrame.TARGET or place is None:
            self._ask(request, words)
            return
        begin_s = request.start_s or view.utc.timestamp()
        length_s = (request.until_s or begin_s + lasts_s * SPARE + SPARE_S) - begin_s

        way, stopped = self._host.begin_way(), view.state.last_stop

        def ready(found: TargetPath | str) -> None:
            way.set_result(None)
            if self._is_gone("No map was begun."):
                return
            now = self._host.view().state
            if now.held is not None or _is_another(stopped, now.last_stop):
                self._host.say(STOPPED)
            elif isinstance(found, str):
                self._host.say(found)
            else:
                name, path = found
                until_s = request.until_s or (path[-1][0] if len(path) > 1 else 0.0)
                self._ask(replace(request, target=name, path=path, until_s=until_s), words)

        self._host.maps.do_beside(lambda: target_path(request.target, place, begin_s, length_s), ready)

    def _ask(self, request: MapRequest, words: str) -> None:
        self._host.ask(BeginTask(KIND, request.values(), YOU))
        when = f" {_clock(request.start_s, self._host.view().utc)}" if request.start_s else ""
        self._show()
        self._host.say(f"{words}{when}. Space: STOP. e: pause.")

    def _resume(self) -> None:
        shown = self._host.view().map
        if shown is None:
            self._host.say(NO_MAP)
        elif shown.is_complete:
            self._host.say("This map is finished. m begins another one.")
        else:
            self._host.maps.head(shown.key, self._ask_again)

    def _ask_again(self, head: MapHead | str) -> None:
        if self._is_gone("The map was not resumed."):
            return
        shown, view = self._host.view().map, self._host.view()
        if isinstance(head, str):
            self._host.say(head)
            return
        if not self._page.is_free:
            self._host.say("The map is ready to resume. u on F3 asks.")
            return
        request = again(head)
        heard = frozenset() if shown is None or shown.key != head.key else shown.heard_cells
        much = estimated(view, request, heard)

        def answered(agreed: bool | None) -> None:
            if agreed:
                self._host.maps.open(head.key)
                self._send(request, much.seconds, "The map goes on")

        words = f"{title_of(head)}: {much.words} left. The dish goes on at the next direction not heard yet. {CLEAR}"
        question = QuestionScreen("Resume the map", words, "area is clear: resume", by_itself=True)
        self._page.app.push_screen(question, answered)

    def _choose(self, found: Sequence[MapHead] | str) -> None:
        if self._is_gone("M on F3 lists the maps."):
            return
        if isinstance(found, str):
            self._host.say(found)
        elif not found:
            self._host.say("No maps are kept yet. m begins one.")
        elif not self._page.is_free:
            self._host.say("The list of maps is ready. M on F3 shows it.")
        else:
            task, shown = map_task(self._host.view().state.tasks), self._host.maps.book.shown
            under_way = "" if task is None else str(task.found.get("map", ""))
            question = maps_question(found, "" if shown is None else shown.key, under_way)
            self._page.app.push_screen(question, self._open)

    def _open(self, key: str | None) -> None:
        if key is not None:
            self._host.maps.open(key)
            self._show()

    def _pause(self) -> None:
        task = map_task(self._host.view().state.tasks)
        if task is not None:
            self._host.ask(EndMotion(task.holder))
            self._host.say(PAUSED)

    def _enter(self) -> None:
        self._show()
        if self._host.view().map is None:
            self._host.say(NO_MAP)
        elif self._pane.has_focus:
            self._pane.leave()
        else:
            self._pane.focus()

    def _recolour(self) -> None:
        """Take the next colours, and keep them for the next start."""
        pane = self._pane
        self._show()
        pane.colours = next_colours(pane.colours or self._host.view().settings.map_colours)
        words = f"Colours of the map: {pane.colours}."
        if self._page.app.theme == "night":
            words = f"{words} The night theme shows {NIGHT} all the same: T changes the theme."
        keep = self._host.settings.keep_map_colours
        if keep is not None:
            try:
                keep(pane.colours)
            except BirdcageError as wrong:
                words = f"The colours were not saved. {wrong}"
        pane.redraw()
        self._host.say(words)

    def _cut(self) -> None:
        pane = self._pane
        self._show()
        pane.cuts = not pane.has_cuts
        pane.redraw()
        self._host.paint()

    def _point(self) -> None:
        """Offer the direction under the cursor, or release what is held first."""
        if self._page.releases_first():
            return
        shown = self._host.view().map
        at = None if shown is None else self._pane.direction(shown)
        if shown is None:
            self._host.say(NO_MAP)
        elif at is not None:
            self._host.open_goto(f"{at[0]:.2f} {at[1]:.2f}")
        elif shown.plan.frame is MapFrame.TARGET:
            self._host.say("A map around a target has no direction to point at: it moves with the target.")
        else:
            self._host.say("Nothing is heard yet, so the cursor is nowhere. Arrows put it into the map.")


def _is_another(before: StopReport | None, now: StopReport | None) -> bool:
    """Return whether a STOP has come since; more may have become known of the one before."""
    return now is not None and (before is None or now.at != before.at)


def _clock(at_s: float, now: datetime) -> str:
    return clock_words(datetime.fromtimestamp(at_s, UTC), now)
