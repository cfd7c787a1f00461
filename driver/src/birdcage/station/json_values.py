"""How single values look in JSON, and back: numbers, text, times, words of an enum, values of features.

What is made from these is in `json_shapes`, which also tells the whole form.
"""

# ruff: noqa: ANN401 - values of any type are told

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any, Protocol

from birdcage.base.errors import BadMessage
from birdcage.base.text import clean

MOST = 2**53
"""Beyond this, programs that keep every number as a float do not agree on whole ones."""
MOST_LISTED = 15
"""Words of an enum that a sentence still lists."""
_MOMENT = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d{1,6})?)?(Z|[+-]\d\d:\d\d)", re.ASCII)


class Shape(Protocol):
    """One type, as JSON."""

    @property
    def words(self) -> str:
        """What JSON it is, for errors and documents: `a number`, `a list, each item text`."""

    def tell(self, value: Any, where: str) -> object:
        """Return a value as JSON; `where` names its field. BadMessage for what JSON can't hold."""

    def take(self, told: object, where: str) -> Any:
        """Return the value of JSON that came from outside. BadMessage for what does not fit."""


def shown(told: object) -> str:
    """Return JSON from outside, short enough for a sentence."""
    if isinstance(told, list | dict):
        return "a list" if isinstance(told, list) else "an object"
    if told is None or isinstance(told, bool):
        return "null" if told is None else str(told).lower()
    text = f'"{told}"' if isinstance(told, str) else str(told)
    return text if len(text) <= 60 else f"{text[:60]}…"


def unfit(told: object, where: str, shape: Shape) -> BadMessage:
    """Return the error for JSON that does not fit."""
    return BadMessage(f"{where} is {shown(told)}. Give {shape.words}.")


class PlainShape:
    """Text, or true and false."""

    def __init__(self, kind: type, words: str) -> None:
        self._kind, self.words = kind, words

    def tell(self, value: Any, where: str) -> object:
        """Return it as it is."""
        if not isinstance(value, self._kind):
            raise unfit(repr(value), where, self)
        return value

    def take(self, told: object, where: str) -> Any:
        """Return it, text clean."""
        if type(told) is not self._kind:
            raise unfit(told, where, self)
        return clean(told) if isinstance(told, str) else told


class NumberShape:
    """A number; a whole one where the field is an `int`."""

    def __init__(self, *, whole: bool) -> None:
        self._whole = whole
        self.words = "a whole number" if whole else "a number"

    def tell(self, value: Any, where: str) -> object:
        """Return it. BadMessage for NaN and infinity, which JSON does not have."""
        if not isinstance(value, int | float) or not math.isfinite(value):
            raise unfit(repr(value), where, self)
        return int(value) if self._whole else float(value)

    def take(self, told: object, where: str) -> Any:
        """Return it; a whole number does for any other."""
        if isinstance(told, bool) or not isinstance(told, int if self._whole else int | float):
            raise unfit(told, where, self)
        if (isinstance(told, int) and abs(told) > MOST) or not math.isfinite(told):
            raise BadMessage(f"{where} is {shown(told)}. Give {self.words} within ±2^53.")
        return told if self._whole else float(told)


class MomentShape:
    """A time."""

    words = "a time like 2026-11-23T06:04:28Z"

    def tell(self, value: Any, where: str) -> object:
        """Return it as text, in UTC."""
        if not isinstance(value, datetime) or value.tzinfo is None:
            raise unfit(repr(value), where, self)
        return f"{value.astimezone(UTC).replace(tzinfo=None).isoformat()}Z"

    def take(self, told: object, where: str) -> Any:
        """Return it, in UTC."""
        if not isinstance(told, str) or not _MOMENT.fullmatch(told):
            raise unfit(told, where, self)
        try:
            return datetime.fromisoformat(told).astimezone(UTC)
        except (ValueError, OverflowError):
            raise unfit(told, where, self) from None


class ChoiceShape:
    """One of some words, or numbers."""

    def __init__(self, choices: Mapping[Any, object], name: str = "") -> None:
        """Take the choices by their words; `name` is what they are called where they are too many to list."""
        self._choices = choices
        self._words = {value: word for word, value in choices.items()}
        listed = ", ".join(map(shown, choices))
        self.words = f"a word of {name}" if name and len(choices) > MOST_LISTED else f"one of {listed}"

    def tell(self, value: Any, where: str) -> object:
        """Return its word."""
        if value not in self._words:
            raise unfit(repr(value), where, self)
        return self._words[value]

    def take(self, told: object, where: str) -> Any:
        """Return what the word stands for."""
        if isinstance(told, bool) or not isinstance(told, str | int) or told not in self._choices:
            raise unfit(told, where, self)
        return self._choices[told]


class OptionalShape:
    """A type, or null for what is not known."""

    def __init__(self, inner: Shape) -> None:
        self._inner = inner
        self.words = f"{inner.words}, or null"

    def tell(self, value: Any, where: str) -> object:
        """Return it, or null."""
        return None if value is None else self._inner.tell(value, where)

    def take(self, told: object, where: str) -> Any:
        """Return it, or None."""
        return None if told is None else self._inner.take(told, where)


class FeatureValueShape:
    """The value of a feature of the dish."""

    words = "a number, text, true or false"

    def tell(self, value: Any, where: str) -> object:
        """Return it; text of several lines as a list of them."""
        if isinstance(value, str):
            return value.split("\n") if "\n" in value else value
        return value if isinstance(value, bool) else NUMBER.tell(value, where)

    def take(self, told: object, where: str) -> Any:
        """Return it; a list of lines as one text."""
        if isinstance(told, list) and told:
            return "\n".join(TEXT.take(line, f"{where}[{at}]") for at, line in enumerate(told))
        if isinstance(told, bool):
            return told
        if isinstance(told, int | float):
            return NUMBER.take(told, where)
        if isinstance(told, str):
            return clean(told)
        raise unfit(told, where, self)


TEXT, NUMBER = PlainShape(str, "text"), NumberShape(whole=False)
WHOLE, TRUTH, MOMENT = NumberShape(whole=True), PlainShape(bool, "true or false"), MomentShape()
