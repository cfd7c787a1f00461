"""Reads values out of replies by their names. Numbers are never counted: unquoted texts may hold more of them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.events import Reply

START = r"(?<![^\s=:(])"
"""Where a value may begin."""
END = r"(?=[.,;)\]]*(?:\s|$))"
"""Where a value ends: what noise has cut in two is none."""
NUMBER = r"[-+]?\d+(?:\.\d+)?(?=[A-Za-z%°/²]*[.,;)\]]*(?:\s|$))"
"""With its unit right behind it, or none."""

_NUMBER = re.compile(rf"{START}{NUMBER}")
_BY_MOTOR = re.compile(rf"\[\s*([01])\s*\]\s*[=:]\s*({NUMBER})")
_WITH_DIGIT = re.compile(r"\S*\d\S*")
_IN_BRACKETS = re.compile(r"\([^)]*\)")
_BOTH = re.compile(r"\bAZ\s*/\s*EL\b(.*)")
_WORD = re.compile(r"[^\s:,;.=/()\[\]]+")
_AZ = re.compile(r"\bAZ\w*\b(.*?)(?=\bEL\w*\b|$)")
_EL = re.compile(r"\bEL\w*\b(.*?)(?=\bAZ\w*\b|$)")

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class PerAxis(Generic[T]):
    """One value for each axis."""

    azimuth: T
    elevation: T


def garbage(reply: Reply) -> NoReply:
    """Return the error for a reply that makes no sense."""
    printed = " / ".join(reply.lines) or "nothing"
    return NoReply(
        f"The dish answered `{reply.command}` with {printed!r}, which makes no sense.", reason=Reason.GARBAGE
    )


def search(reply: Reply, pattern: re.Pattern[str]) -> re.Match[str] | None:
    """Return the first match in a line of the reply."""
    return next((m for m in map(pattern.search, reply.lines) if m), None)


def find(reply: Reply, pattern: re.Pattern[str]) -> re.Match[str]:
    """Return the first match in a line of the reply; NoReply (garbage) when there is none."""
    found = search(reply, pattern)
    if found is None:
        raise garbage(reply)
    return found


def only_text(reply: Reply) -> str:
    """Return the number of a reply that holds a single one, remarks in brackets aside; NoReply (garbage) otherwise.

    A word with a digit in it counts as another, as noise may have made it of one.
    """
    text = _IN_BRACKETS.sub("", "\n".join(reply.lines))
    numbers: list[str] = _NUMBER.findall(text)
    if len(numbers) != 1 or len(_WITH_DIGIT.findall(text)) != 1:
        raise garbage(reply)
    return numbers[0]


def only_whole(reply: Reply) -> int:
    """Return the number of a reply that holds a single, whole one; NoReply (garbage) otherwise."""
    text = only_text(reply)
    if "." in text:
        raise garbage(reply)
    return int(text)


def by_motor(reply: Reply) -> PerAxis[str]:
    """Read `Name[0] = 1` and `Name[1] = 2`, on one line or two; NoReply (garbage) unless both are there."""
    found = {m[1]: m[2] for line in reply.lines for m in _BY_MOTOR.finditer(line)}
    if set(found) != {"0", "1"}:
        raise garbage(reply)
    return PerAxis(found["0"], found["1"])


def by_axis(reply: Reply, words: Mapping[str, T]) -> PerAxis[T]:
    """Read one of some words after `AZ` and one after `EL` (`AZ DIAG: OK EL DIAG: OK`), or after `AZ/EL` for both.

    NoReply (garbage) unless both are there.
    """
    text = " ".join(reply.lines)
    both = _BOTH.search(text)
    found = [_word(part[1], words) if part else None for part in (both or _AZ.search(text), both or _EL.search(text))]
    if found[0] is None or found[1] is None:
        raise garbage(reply)
    return PerAxis(words[found[0]], words[found[1]])


def _word(text: str, words: Mapping[str, T]) -> str | None:
    spelt = {word.lower(): word for word in words}
    return next((spelt[word.lower()] for word in _WORD.findall(text) if word.lower() in spelt), None)
