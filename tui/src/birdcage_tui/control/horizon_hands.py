"""What the keys of the horizon do on the control page, and what they ask before."""

from __future__ import annotations

import math
import re
from typing import cast

from birdcage.base.errors import ConfigError
from birdcage.sky.horizon import HorizonMask
from textual.widget import Widget

from birdcage_tui.commands.horizon import can_mark
from birdcage_tui.control.ask import Change
from birdcage_tui.control.sketch_screen import SketchScreen
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.horizon_state import count_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

EXAMPLE = "azimuth and elevation: 231 12.3"
_TIGHT_COMMA = re.compile(r"(?<=\d),(?=\d)")


def point_of(text: str) -> tuple[float, float]:
    """Return the azimuth and elevation that were typed. ValueError says what to type instead."""
    plain = text.replace("°", " ").replace("−", "-")
    words = re.split(r"[\s/;]+|,\s+", plain.strip())
    if len(words) == 1 and len(_TIGHT_COMMA.findall(words[0])) == 1:
        words = _TIGHT_COMMA.split(words[0])
    try:
        az_deg, el_deg = (float(_TIGHT_COMMA.sub(".", word)) for word in words if word)
    except ValueError:
        raise ValueError(f"Type two numbers in degrees, {EXAMPLE}.") from None
    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise ValueError(f"Type two numbers in degrees, {EXAMPLE}.")
    if abs(az_deg) > 360.0:
        raise ValueError(f"Azimuth {az_deg:g}° is beyond a full turn. Type 0 to 360.")
    if abs(el_deg) > 90.0:
        raise ValueError(f"Elevation {el_deg:g}° is out of range. Type 0 (horizon) to 90 (zenith).")
    return az_deg % 360.0, el_deg


class HorizonHands:
    """Marks, records, types, takes back and clears; `page` is where the dialogs are put over."""

    def __init__(self, page: Widget) -> None:
        self._page = page

    @property
    def _host(self) -> AppHost:
        return cast(AppHost, self._page.app)

    def do(self, command: str) -> bool:
        """Carry out a command; False for one that is none of the horizon's."""
        book = self._host.horizon
        match command:
            case "horizon-mark":
                self._mark()
            case "horizon-record":
                self._tell(lambda: book.record(not book.recording))
            case "horizon-type":
                self._type()
            case "horizon-draw":
                self._draw()
            case "horizon-undo":
                self._tell(book.undo)
            case "horizon-clear":
                self._clear()
            case _:
                return False
        return True

    def look(self, view: View) -> None:
        """While recording: see whether the dish has come to rest after a jog, and keep that point."""
        book, position = self._host.horizon, view.state.position
        if not book.recording:
            return
        if position is None or can_mark(view) is not None:
            book.unrest()
        elif book.rest(position.az_deg, position.el_deg, position.told_at, view.now):
            # Not in the middle of a frame: it writes a file, and paints.
            self._page.call_later(self._tell, lambda: book.mark(position.az_deg, position.el_deg))

    def _mark(self) -> None:
        position = self._host.view().state.position
        if position is not None:
            self._tell(lambda: self._host.horizon.mark(position.az_deg, position.el_deg))

    def _type(self) -> None:
        def answered(values: tuple[str, ...] | None) -> None:
            if values is not None:
                self._tell(lambda: self._host.horizon.mark(*point_of(values[0])))

        self._page.app.push_screen(_point_form(), answered)

    def _draw(self) -> None:
        book = self._host.horizon
        before = book.mask

        def answered(drawn: HorizonMask | None) -> None:
            if drawn is not None and drawn != before:
                self._tell(lambda: book.draw(drawn))

        self._page.app.push_screen(SketchScreen(before), answered)

    def _clear(self) -> None:
        book = self._host.horizon

        def answered(agreed: bool | None) -> None:
            if agreed:
                self._tell(book.clear)

        self._page.app.push_screen(QuestionScreen(*_clear_question(book.mask)), answered)

    def _tell(self, change: Change) -> None:
        """Change the horizon, and say what was done or why not."""
        try:
            words = change()
        except ConfigError as refused:
            words = str(refused)
        self._host.say(words)


def _point_form() -> FieldsScreen:
    """Return the form for a point."""

    def check(values: Values) -> str:
        try:
            point_of(values[0])
        except ValueError as wrong:
            return str(wrong)
        return ""

    words = (
        "The top of a tree or a roof, in true degrees. Straight lines join the points. The horizon limits passes, not "
        "motion."
    )
    return FieldsScreen("Horizon point", words, (FieldRow("az el", "", EXAMPLE),), check)


def _clear_question(mask: HorizonMask) -> tuple[str, str, str]:
    """Return title, words and consent of clearing the horizon."""
    words = (
        f"This deletes {count_text(mask)} and makes the horizon flat. Passes then count as in reach behind trees. "
        "z restores the points while the app runs. Nothing moves."
    )
    return "Clear the horizon", words, "make it flat"
