"""What a person adds from any page: elements, and the place of the dish."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError

from birdcage_tui.shown.options import SitePlace
from birdcage_tui.widgets.fields_screen import LINE_END, FieldRow, FieldsScreen, Values

if TYPE_CHECKING:
    from birdcage_tui.feeds.sky_add import AddOutcome
    from birdcage_tui.shell.birdcage_app import BirdcageApp


def ask_elements(app: BirdcageApp, typed: str = "", wrong: str = "") -> None:
    """Ask for a path or a text; what can't be read stands there again, with the lines that are wrong."""

    def check(values: Values) -> str:
        return "" if values[0].strip() else "Type a path, or paste elements."

    def told(text: str, added: AddOutcome) -> None:
        if added.whole:
            app.say(added.words)
        else:
            ask_elements(app, text, added.words)

    def answered(values: Values | None) -> None:
        if values is None:
            return
        text = values[0]
        if not app.sky.add_elements(text.replace(LINE_END, "\n"), lambda added: app.soon(partial(told, text, added))):
            app.say("This app watches no sky, so it has no elements.")

    words = "Type the path of a file with TLE or OMM, or paste its text. The newest elements of each satellite count."
    fields = (FieldRow("elements", typed, "~/iss.txt, or paste", pastes=True),)
    app.push_screen(FieldsScreen("Add elements", words, fields, check, wrong), answered)


def ask_place(app: BirdcageApp) -> None:
    """Ask where the dish stands; it counts at once."""
    from birdcage.sky.whereabouts import parse_place

    keep: Callable[[float, float, float, str], None] | None = app.settings.keep_place
    if keep is None:
        app.say("This app keeps no settings, so it can't save a location.")
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
            app.say(str(problem))
            return
        app.move_to(SitePlace(found.latitude_deg, found.longitude_deg, found.name))
        where = f"{found.name}, " if found.name else ""
        app.say(f"Location set: {where}{found.latitude_deg:.4f}°, {found.longitude_deg:.4f}°.")

    words = "Type a city, a locator, or latitude and longitude. Passes are recomputed at once."
    fields = (FieldRow("location", "", "Rotterdam or JO21jv"),)
    app.push_screen(FieldsScreen("Set location", words, fields, check, read=lambda values: place_words(values[0])),
                    answered)  # fmt: skip


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
