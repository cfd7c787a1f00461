"""What the map that is shown teaches: horizon, north and tilt, beam and noise, each offered and kept when accepted."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import shortest_turn
from birdcage.station.requests import ApplySettings

from birdcage_tui.feeds.calibrate_feed import ABSENT
from birdcage_tui.shown.map_offer import MapOffer
from birdcage_tui.shown.view import YOU
from birdcage_tui.signal.map_work import NO_MAP, MapWork
from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen
from birdcage_tui.widgets.dialogs import QuestionScreen

if TYPE_CHECKING:
    from birdcage.skymap.arc_lesson import ArcLesson
    from birdcage.skymap.horizon_lesson import HorizonProposal
    from birdcage.skymap.lesson_inputs import LessonInputs
    from birdcage.skymap.sun_lesson import SunLesson

    from birdcage_tui.shown.map_book import MapShown
    from birdcage_tui.widgets.page import Page

Found = TypeVar("Found")
ROWS = (
    ChoiceRow("horizon", "Horizon", "trees and roofs, accepted point by point"),
    ChoiceRow("north", "North and tilt", "by the arc of satellites, handed to Calibrate"),
    ChoiceRow("beam", "Beam, system temperature and G/T", "by the Sun, kept with the feed"),
)
WORDS = "Nothing is kept before you accept it."
NO_SETTINGS = "This app has no settings to keep it in. Use `birdcage maps` in a terminal."
NOTHING = "No points accepted. The horizon is unchanged."
ELSEWHERE = "This map was made at another place. The horizon of the active place is unchanged."


class MapTeach(MapWork):
    """`page` is where the map is seen."""

    def __init__(self, page: Page, show: Callable[[], object]) -> None:
        """`show`: shows the map on the page."""
        super().__init__(page)
        self._show = show
        self._at_work = False
        self._ready: tuple[str, Callable[[], object]] | None = None
        """The map of a result that came while something else was on the screen, and what shows it."""

    def ask(self) -> None:
        """Ask which lesson; or show the result of one that is ready."""
        (made, ready), self._ready = self._ready or ("", None), None
        now = self._host.view().map
        if ready is not None and now is not None and now.key == made:
            ready()
        elif self._host.view().map is None:
            self._host.say(NO_MAP)
        elif self._host.settings.lessons is None:
            self._host.say(NO_SETTINGS)
        elif self._at_work:
            self._host.say("Still computing.")
        else:
            self._page.app.push_screen(ChoiceScreen("What this map teaches", ROWS, WORDS), self._begin)

    def _begin(self, which: str | None) -> None:
        view = self._host.view()
        shown, lessons = view.map, self._host.settings.lessons
        if which is None or shown is None or lessons is None:
            return
        inputs = partial(lessons.inputs, shown.sky, view.state.beam)
        match which:
            case "horizon" if shown.is_elsewhere(self._host.settings.place):
                self._host.say(ELSEWHERE)
            case "horizon":
                self._compute(shown.key, lambda: inputs().horizon(), partial(self._offer, shown))
            case "north":
                self._compute(shown.key, lambda: inputs().north(), partial(self._offer_north, shown))
            case _:

                def sun() -> tuple[LessonInputs, SunLesson]:
                    told = inputs()
                    return told, told.sun()

                self._compute(shown.key, sun, partial(self._offer_beam, shown))

    def _compute(self, made: str, work: Callable[[], Found], tell: Callable[[Found], object]) -> None:
        self._at_work = True
        self._host.say("Computing …")

        def told(found: Found | str) -> None:
            self._at_work = False
            if self._is_gone("y on F3 computes it again."):
                return
            if isinstance(found, str):
                self._host.say(found)
            elif self._page.is_free:
                tell(found)
            else:
                self._ready = made, partial(tell, found)
                self._host.say("What the map teaches is ready. y on F3 shows it.")

        self._host.maps.do_beside(work, told)

    def _why_not_kept(self, shown: MapShown) -> str:
        lessons = self._host.settings.lessons
        return NO_SETTINGS if lessons is None else lessons.why_not_kept(shown.sky)

    # The horizon.

    def _offer(self, shown: MapShown, found: HorizonProposal) -> None:
        now = self._host.view().map
        if now is None or now.key != shown.key:
            self._host.say("Another map is shown now, so its horizon is not proposed.")
            return
        self._show()
        self._pane.offer = MapOffer(shown.key, found.points)
        self._page.screen.set_focus(self._pane)
        self._host.say(f"{len(found.points)} points proposed. The head line of the map names the keys.")
        self._host.paint()

    def keep_horizon(self) -> None:
        """Put the points that were accepted into the horizon of the place, or release what is held first."""
        if self._page.releases_first():
            return
        offer, shown = self._pane.offer, self._host.view().map
        if offer is None or shown is None or shown.key != offer.key:
            return
        if not offer.accepted:
            self._host.say(NOTHING)
            return
        why = ELSEWHERE if shown.is_elsewhere(self._host.settings.place) else self._why_not_kept(shown)
        if why:
            self._host.say(why)
            return
        try:
            words = self._host.horizon.accept(offer.points, offer.accepted)
        except BirdcageError as wrong:
            self._host.say(str(wrong))
            return
        self._pane.offer = None
        self._host.say(words)
        self._host.paint()

    # North and tilt.

    def _offer_north(self, shown: MapShown, found: ArcLesson) -> None:
        from birdcage.calibration.map_peaks import peaks_of_map

        words, why = north_words(found), self._why_not_kept(shown)
        if why:
            self._host.say(f"{why} {words.splitlines()[0]}")
            return
        peaks = peaks_of_map(found)

        def answered(agreed: bool | None) -> None:
            if not agreed:
                return
            calibrate = self._host.calibrate
            calibrate.open()
            if calibrate.source is None:
                self._host.say(ABSENT)
                return
            calibrate.source.put(peaks)
            self._host.say(f"{len(peaks)} peaks handed to Calibrate. F8 C shows the fit; a applies it.")

        yes = f"hand {len(peaks)} peaks to Calibrate"
        question = QuestionScreen("North and tilt by the arc", words, yes, by_itself=True)
        self._page.app.push_screen(question, answered)

    # Beam and noise.

    def _offer_beam(self, shown: MapShown, found: tuple[LessonInputs, SunLesson]) -> None:
        from birdcage.skymap.sun_kept import lesson_lines, why_not_kept

        inputs, lesson = found
        lines, why = lesson_lines(lesson), self._why_not_kept(shown) or why_not_kept(lesson)
        if why:
            self._host.say(f"{why} {lines[0]}.")
            return

        def answered(agreed: bool | None) -> None:
            lessons = self._host.settings.lessons
            if not agreed or lessons is None:
                return
            try:
                words, settings = lessons.keep_beam(inputs, lesson)
            except BirdcageError as wrong:
                self._host.say(str(wrong))
                return
            self._host.ask(ApplySettings(settings, YOU))
            self._host.say(words)

        yes = f"keep beam and noise with the feed {inputs.feed_name}"
        question = QuestionScreen("Beam and noise by the Sun", "\n".join(lines), yes, by_itself=True)
        self._page.app.push_screen(question, answered)


def north_words(found: ArcLesson) -> str:
    """Return what was found, for a question."""
    stands, (turn, to_north, to_west) = found.alignment, found.sigmas_deg
    heard = ", ".join(each.seen.slot.label for each in found.slots)
    offset_deg = shortest_turn(0.0, stands.az_offset_deg)
    return (
        f"Azimuth offset {offset_deg:+.2f}° ±{turn:.2f}°. Tilt {math.hypot(stands.an_deg, stands.aw_deg):.2f}°: "
        f"{stands.an_deg:+.2f}° ±{to_north:.2f}° to the north, {stands.aw_deg:+.2f}° ±{to_west:.2f}° to the west.\n"
        f"Measured: {heard}. The offset in elevation is held. Calibrate fits all terms to these peaks, and to "
        "those it has."
    )
