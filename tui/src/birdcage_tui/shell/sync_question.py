"""Asks where a machine points, and syncs it: nothing moves by it."""

from __future__ import annotations

import math
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Protocol

from birdcage.base.errors import ConfirmationNeeded
from birdcage.station.requests import Sync
from textual.app import App

from birdcage_tui.feeds.app_host import AppHost, ShownDish
from birdcage_tui.shown.view import YOU
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

if TYPE_CHECKING:
    from collections.abc import Callable

WORDS = (
    "Sight along it and measure where it points: azimuth clockwise from true north, elevation above the horizon. "
    "A compass shows magnetic north: correct for declination. Nothing moves."
)


TITLE = "Sync: say where it points"


class SyncHost(AppHost, Protocol):
    """The app, seen from here."""

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""


class SyncQuestion:
    """A form of two lines; where the machine believes otherwise, that is asked before it is synced."""

    def __init__(self, app: App[None], host: SyncHost) -> None:
        self._app, self._host = app, host

    def ask(self) -> None:
        """Show the form, with where it is known to point."""
        dish = self._host.dish
        state = self._host.view().state
        known = state.position if state.position_lost is None else None
        az, el = ("", "") if known is None else (f"{known.az_deg:.1f}", f"{known.el_deg:.1f}")
        measures = state.dish is not None and state.dish.elevation.name not in state.dish.zero_at_power_up
        hint = "optional: it measures that itself" if measures else "degrees above the horizon"
        fields = (FieldRow("azimuth", az, "0 to 360, true"), FieldRow("elevation", el, hint))

        def answered(values: Values | None) -> None:
            if values is not None:
                el_deg = _angle(values[1]) if values[1].strip() else None
                self._sync(dish, Sync(_angle(values[0]), el_deg, YOU))

        def check(values: Values) -> str:
            return _wrong(values, may_lack=measures)

        self._app.push_screen(FieldsScreen(TITLE, WORDS, fields, check, enter="Enter: sync"), answered)

    def _sync(self, dish: ShownDish, request: Sync) -> None:
        """Sync this dish; its answer is about it, also when it comes while another one is shown."""

        def done(future: Future[object]) -> None:
            error = None if future.cancelled() else future.exception()
            if isinstance(error, ConfirmationNeeded):
                self._host.soon(partial(self._confirm, dish, request, str(error)))
                return
            words = f"Synced to azimuth {request.az_deg:.2f}°." if error is None else str(error)
            self._host.soon(partial(dish.say, words))

        dish.station.submit(request).add_done_callback(done)

    def _confirm(self, dish: ShownDish, request: Sync, words: str) -> None:
        if not may_open(self._app, dish):
            dish.say(f"Press Y again: {words}")
            return

        def answered(agreed: bool | None) -> None:
            if agreed:
                self._sync(dish, replace(request, agreed=True))

        self._app.push_screen(QuestionScreen(TITLE, words, "sync", by_itself=True), answered)


def may_open(app: App[None], dish: ShownDish) -> bool:
    """Return whether a dialog about this dish may open late: while it is shown, and no other dialog is."""
    return dish.is_shown and len(app.screen_stack) == 1


def _angle(text: str) -> float:
    """Return what was typed in degrees; NaN for what is no number."""
    try:
        return float(text.strip().replace(",", ".").rstrip("°").strip())
    except ValueError:
        return math.nan


def _wrong(values: Values, *, may_lack: bool) -> str:
    """Return what is wrong with what was typed; empty for nothing."""
    if not 0.0 <= _angle(values[0]) <= 360.0:
        return "Type the azimuth: 0 to 360."
    if not values[1].strip():
        return "" if may_lack else "Type the elevation: -90 to 90."
    return "" if -90.0 <= _angle(values[1]) <= 90.0 else "Type the elevation: -90 to 90."
