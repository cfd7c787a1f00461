"""The arguments of commands: what a token must look like to be one, and what it means.

A token that does not fit is refused whole: nothing is read out of its beginning, as C's `scanf` would do. NaN and
infinity are no numbers here: no dish can point there.
"""

from __future__ import annotations

import math
import re
from enum import Enum

from birdcage.rotctld.rotor import MoveDirection

_NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d{1,3})?", re.ASCII)
_INTEGER = re.compile(r"[+-]?\d{1,9}", re.ASCII)
_WORD = re.compile(r"[!-~]+")
_LINE = re.compile(r"[ -~]+")
_PAIR = re.compile(r"([+-]?\d+\.\d+),([+-]?\d+\.\d+)", re.ASCII)

_UP, _DOWN, _LEFT, _RIGHT = MoveDirection.UP, MoveDirection.DOWN, MoveDirection.LEFT, MoveDirection.RIGHT
_WORDS = {
    "UP": _UP, "DOWN": _DOWN, "LEFT": _LEFT, "CCW": _LEFT, "RIGHT": _RIGHT, "CW": _RIGHT,
    "UP_LEFT": _UP | _LEFT, "UP_CCW": _UP | _LEFT, "UP_RIGHT": _UP | _RIGHT, "UP_CW": _UP | _RIGHT,
    "DOWN_LEFT": _DOWN | _LEFT, "DOWN_CCW": _DOWN | _LEFT, "DOWN_RIGHT": _DOWN | _RIGHT, "DOWN_CW": _DOWN | _RIGHT,
}  # fmt: skip
_NUMBERS = {
    2: _UP, 4: _DOWN, 8: _LEFT, 16: _RIGHT, 32: _UP | _LEFT, 64: _UP | _RIGHT, 128: _DOWN | _LEFT, 256: _DOWN | _RIGHT,
}  # fmt: skip
"""Hamlib's, the diagonals those of 4.6 and later."""


class ArgumentShape(Enum):
    """What stands behind a command. Hamlib's clients send arguments over several lines where they are `NUMBERS`."""

    NUMBER = "number"
    INTEGER = "integer"
    DIRECTION = "direction"
    WORD = "word"
    LINE = "line"
    """All that is left of the line."""

    def fits(self, token: str) -> bool:
        """Return whether a token, or for LINE the rest of a line, can be this argument."""
        if self is ArgumentShape.NUMBER:
            return _NUMBER.fullmatch(token) is not None and math.isfinite(number(token))
        if self is ArgumentShape.INTEGER:
            return _INTEGER.fullmatch(token) is not None
        if self is ArgumentShape.DIRECTION:
            return token.upper() in _WORDS or (_INTEGER.fullmatch(token) is not None and int(token) in _NUMBERS)
        return (_WORD if self is ArgumentShape.WORD else _LINE).fullmatch(token) is not None

    @property
    def may_follow(self) -> bool:
        """Whether it may stand on the next line: only where a command can't be taken for it, nor it for a command."""
        return self not in (ArgumentShape.WORD, ArgumentShape.LINE)


def number(token: str) -> float:
    """Return a number; a comma is a decimal point: Gpredict writes `148,17` where the language of its user does."""
    return float(token.replace(",", "."))


def direction(token: str) -> MoveDirection:
    """Return a direction of `M`: by Hamlib's number, or its word in any case."""
    return _WORDS[token.upper()] if token.upper() in _WORDS else _NUMBERS[int(token)]


def pair(token: str) -> tuple[str, str] | None:
    """Return the two numbers of `10.5,20.5`: points tell that its comma is no decimal one. None of any other token."""
    found = _PAIR.fullmatch(token)
    return (found[1], found[2]) if found else None
