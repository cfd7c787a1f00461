"""What a command asks in words before it is done: a motion that needs a clear area, elements, the place of the dish."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Protocol

from birdcage.base.errors import BirdcageError
from birdcage.station.requests import AcceptLimits, Home, SetSearch
from textual.app import App

from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.sync_question import SyncHost, SyncQuestion, may_open
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.stop_words import power_switch
from birdcage_tui.shown.view import YOU
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import LINE_END, FieldRow, FieldsScreen, Values

if TYPE_CHECKING:
    from birdcage_tui.feeds.sky_add import AddOutcome


class QuestionHost(SyncHost, Protocol):
    """The app, seen from its questions."""

    settings: AppOptions

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""

    def move_to(self, place: SitePlace) -> None:
        """Let every page and the search for passes count from another place."""


class Questions:
    """Each shows a dialog, and does what its title says once that is answered with yes."""

    def __init__(self, app: App[None], host: QuestionHost) -> None:
        self._app, self._host = app, host
        self.sync = SyncQuestion(app, host)

    def _confirm(self, title: str, words: str, yes: str, deed: Callable[[], None]) -> None:
        self._app.push_screen(QuestionScreen(title, words, yes), lambda agreed: deed() if agreed else None)

    def home(self) -> None:
        """Ask in words, then home."""
        dish = self._host.view().state.dish
        takes = "T" if dish is None or dish.homing_s is None else f"In up to {dish.homing_s * 2:.0f} s t"
        stoppable = dish is not None and dish.homing_stoppable
        words = f"{takes}he dish turns through its whole range and runs into its end stops. Keep its swing clear."
        if not stoppable:
            words += f" Homing can't be stopped: keep a hand on the {power_switch(self._host.view())}."

        self._confirm("Home the dish", words, "area is clear: home", lambda: self._host.ask(Home(YOU)))

    def limits(self, because: str) -> None:
        """Ask in words, then move within the dish's own limits although yours could not be read."""
        words = (
            f"{because}\n\nUntil you fix the file, only the dish's own limits apply. Your limits are unknown: "
            "a wall or a low roof does not stop a motion. Nothing moves now."
        )

        self._confirm(
            "Move without your own limits",
            words,
            "accept the dish's own limits",
            lambda: self._host.ask(AcceptLimits(YOU)),
        )

    def end_search(self) -> None:
        """Ask in words, then end the firmware's TV search."""
        words = (
            "This ends the firmware's TV search, and the dish stays in place. "
            "The search starts again at each power-up. This dish has no setting to disable it."
        )

        self._confirm("End the TV search", words, "end it", lambda: self._host.ask(SetSearch(YOU, disabled=True)))

    def elements(self, typed: str = "", wrong: str = "") -> None:
        """Ask for a path or a text; what can't be read stands there again, with the lines that are wrong."""

        def check(values: Values) -> str:
            return "" if values[0].strip() else "Type a path, or paste elements."

        dish = self._host.dish

        def told(text: str, added: AddOutcome) -> None:
            if added.whole or not may_open(self._app, dish):
                dish.say(added.words)
            else:
                self.elements(text, added.words)

        def answered(values: Values | None) -> None:
            if values is None:
                return
            text = values[0]
            if not self._host.sky.add_elements(
                text.replace(LINE_END, "\n"), lambda added: self._host.soon(partial(told, text, added))
            ):
                self._host.say("This app watches no sky, so it has no elements.")

        words = (
            "Type the path of a file with TLE or OMM, or paste its text. The newest elements of each satellite count."
        )
        fields = (FieldRow("elements", typed, "~/iss.txt, or paste", pastes=True),)
        self._app.push_screen(FieldsScreen("Add elements", words, fields, check, wrong), answered)

    def place(self) -> None:
        """Ask where the dish stands; it counts at once."""
        from birdcage.sky.whereabouts import parse_place

        keep: Callable[[float, float, float, str], None] | None = self._host.settings.keep_place
        if keep is None:
            self._host.say("This app keeps no settings, so it can't save a location.")
            return

        def check(values: Values) -> str:
            try:
                parse_place(values[0])
            except ValueError as problem:
                return _problem(problem)
            return ""

        def answered(values: Values | None) -> None:
            if values is None:
                return
            found = parse_place(values[0])
            try:
                keep(found.latitude_deg, found.longitude_deg, found.height_m, found.name)
            except BirdcageError as problem:
                self._host.say(str(problem))
                return
            self._host.move_to(SitePlace(found.latitude_deg, found.longitude_deg, found.name))
            where = f"{found.name}, " if found.name else ""
            self._host.say(f"Location set: {where}{found.latitude_deg:.4f}°, {found.longitude_deg:.4f}°.")

        words = "Type a city, a locator, or latitude and longitude. Passes are recomputed at once."
        fields = (FieldRow("location", "", "Rotterdam or JO21jv"),)
        asks = FieldsScreen("Set location", words, fields, check, read=lambda values: place_words(values[0]))
        self._app.push_screen(asks, answered)


def place_words(typed: str) -> str:
    """Return where a text lies, with the country of a city; why it can't be told, where it can't; empty for nothing."""
    from birdcage.sky.cities import search_cities
    from birdcage.sky.whereabouts import parse_place

    if not typed.strip():
        return ""
    try:
        found = parse_place(typed)
    except ValueError as problem:
        return _problem(problem)
    here = found.latitude_deg, found.longitude_deg
    cities = search_cities(typed, 6) if found.name else ()
    label = next((each.label for each in cities if (each.latitude_deg, each.longitude_deg) == here), found.name)
    angles = [f"{abs(deg):.4f}° {signs[deg < 0]}" for deg, signs in zip(here, ("NS", "EW"), strict=True)]
    height = f", {found.height_m:.0f} m" if found.height_m else ""
    return f"{label}{': ' if label else ''}{', '.join(angles)}{height}"


def _problem(problem: ValueError) -> str:
    """Return why a text is no place; of several that it may be, the names, which tell them apart without angles."""
    return re.sub(r" \(-?[\d.]+, -?[\d.]+\)", "", str(problem))
