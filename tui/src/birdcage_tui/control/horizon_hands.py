"""What the keys of the horizon do on the control page."""

from __future__ import annotations

from typing import cast

from birdcage.base.errors import ConfigError
from birdcage.sky.horizon import HorizonMask
from textual.widget import Widget

from birdcage_tui.commands.horizon import can_mark
from birdcage_tui.control import horizon_ask
from birdcage_tui.control.ask import Change
from birdcage_tui.control.sketch_screen import SketchScreen
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.dialogs import QuestionScreen


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
                self._tell(lambda: self._host.horizon.mark(*horizon_ask.point_of(values[0])))

        self._page.app.push_screen(horizon_ask.point(), answered)

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

        self._page.app.push_screen(QuestionScreen(*horizon_ask.clear(book.mask)), answered)

    def _tell(self, change: Change) -> None:
        """Change the horizon, and say what was done or why not."""
        try:
            words = change()
        except ConfigError as refused:
            words = str(refused)
        self._host.say(words)
