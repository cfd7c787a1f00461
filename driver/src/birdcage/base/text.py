"""Text from outside: names in element sets, lines of a dish, settings, answers of servers.

A terminal takes control characters for orders (ECMA-48: C0 and C1 set titles, clear screens, move the cursor), and
bidirectional ones (Unicode UAX #9) make a name read as another. They go where text comes in, so that no face has to
think of them.
"""

from __future__ import annotations

from typing import TypeVar

_LOST = "\ufffd"
_Value = TypeVar("_Value")


def clean(text: str) -> str:
    """Return text without what no cell of a terminal shows: control, C1, bidi and other format characters.

    Line ends, tabs and blanks of every kind become a plain blank; half a surrogate pair, and what Unicode assigns to
    nothing, become U+FFFD. The length may change, the number of words does not.
    """
    return text if text.isprintable() else "".join(map(_shown, text))


def clean_all(value: _Value) -> _Value:
    """Return what a parser (TOML, JSON) made of a file, with every text in it clean, the keys too."""
    if isinstance(value, str):
        return clean(value)  # type: ignore[return-value]
    if isinstance(value, dict):
        return {clean_all(key): clean_all(each) for key, each in value.items()}  # type: ignore[return-value]
    if isinstance(value, list):
        return [clean_all(each) for each in value]  # type: ignore[return-value]
    return value


def _shown(character: str) -> str:
    if character.isprintable():
        return character
    if character.isspace():
        return " "
    from unicodedata import category

    return "" if category(character) in ("Cc", "Cf") else _LOST
