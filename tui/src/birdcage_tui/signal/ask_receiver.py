"""Sets the receiver in the dish, once a person has said so: 13 V for the LNB, another transponder."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.errors import OutOfRange
from birdcage.rotator.feature import ENABLE_LNA, TRANSPONDER, Feature
from birdcage.station.requests import Read, Set

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.signal.receiver import CHANNEL_POLARISATION, SUPPLY, value_text
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

TOLD_AFTER = (TRANSPONDER, "frequency", CHANNEL_POLARISATION, "symbol_rate", SUPPLY)
"""What is read anew after either: it is another value then, or tells that it is not."""


def supply_question(view: View) -> QuestionScreen:
    """Return the question before 13 V: what it does, and what the LNB has now."""
    feature = _features(view).get(ENABLE_LNA)
    now = value_text(view.state.readings.get(SUPPLY)) or "not read yet"
    hazard = "" if feature is None else feature.hazard
    return QuestionScreen("13 V for the LNB", f"{hazard}\n\nSupply now: {now}.", "switch to 13 V")


def transponder_question(view: View) -> FieldsScreen:
    """Return the line for its number. KeyError for a dish that can't be tuned."""
    feature = _features(view)[TRANSPONDER]
    now = value_text(view.state.readings.get(TRANSPONDER))
    tuned = f"Tuned now: {now}." if now else "What it is tuned to is not known."
    limits = "" if feature.range is None else f"{feature.range}"
    words = f"{feature.label}. {tuned} {feature.note}".strip()
    row = FieldRow("transponder", "", limits)
    return FieldsScreen(
        "Transponder", words, (row,), lambda values: wrong_transponder(values, feature), enter="Enter tunes"
    )


def wrong_transponder(values: Values, feature: Feature) -> str:
    """Return what is wrong with a number; empty for one that there is."""
    text = values[0].strip()
    if not text.isdecimal():
        limits = "" if feature.range is None else f" Type {feature.range}."
        return f"{text!r} is no number of a transponder.{limits}"
    try:
        feature.check(float(text))
    except OutOfRange as wrong:
        return str(wrong)
    return ""


def tune(host: AppHost, values: Values) -> None:
    """Have the receiver tune to the transponder that was typed."""
    number = int(values[0])
    _set(host, Set(TRANSPONDER, float(number), YOU), f"Tuning to transponder {number}.")


def supply_13_volts(host: AppHost) -> None:
    """Have the LNB fed with 13 V: a person was told what that does, and agreed."""
    _set(host, Set(ENABLE_LNA, True, YOU, agreed=True), "Switching the LNB to 13 V. A power cycle brings 18 V back.")


def _set(host: AppHost, request: Set, words: str) -> None:
    """Say what is done, have it done, and have read what then holds; what refuses it is said instead."""
    host.say(words)
    host.ask(request)
    told = tuple(each for each in TOLD_AFTER if each in _features(host.view()))
    if told:
        host.ask(Read(told))


def _features(view: View) -> Mapping[str, Feature]:
    return {} if view.state.dish is None else view.state.dish.features
