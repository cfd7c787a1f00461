"""Reads values out of replies by their names. Numbers are never counted: unquoted texts may hold more of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.events import Reply
from birdcage.protocol.motors import AZIMUTH, ELEVATION
from birdcage.rotator.feature import Value

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

Fields = Mapping[str, tuple[re.Pattern[str], Callable[[re.Match[str]], Value]]]
"""How to find what a reply tells, by the id of its feature: a pattern, and what its match means."""


def fields_of(text: str, fields: Fields) -> dict[str, Value]:
    """Return what a text tells of some features, by id; what is not found in it is left out."""
    found = ((name, pattern.search(text), meaning) for name, (pattern, meaning) in fields.items())
    return {name: meaning(match) for name, match, meaning in found if match}


def per_axis(name: str, values: Mapping[str, Value | None]) -> dict[str, Value]:
    """Return what is told of each axis as features: `speed.azimuth`; what is None is left out."""
    return {f"{name}.{axis}": value for axis, value in values.items() if value is not None}


def printed(name: str, lines: Iterable[str]) -> dict[str, Value]:
    """Return the lines of a reply as one feature; none where it had none."""
    text = "\n".join(lines)
    return {name: text} if text else {}


def garbage(reply: Reply) -> NoReply:
    """Return the error for a reply that makes no sense."""
    text = " / ".join(reply.lines) or "nothing"
    return NoReply(f"The dish answered `{reply.command}` with {text!r}, which makes no sense.", reason=Reason.GARBAGE)


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


def by_motor(reply: Reply) -> dict[str, str]:
    """Read `Name[0] = 1` and `Name[1] = 2`, on one line or two, by axis; NoReply (garbage) unless both are there."""
    found = {m[1]: m[2] for line in reply.lines for m in _BY_MOTOR.finditer(line)}
    if set(found) != {"0", "1"}:
        raise garbage(reply)
    return {AZIMUTH: found["0"], ELEVATION: found["1"]}


def by_axis(reply: Reply, words: Iterable[str]) -> dict[str, str]:
    """Read one of some words after `AZ` and one after `EL` (`AZ DIAG: OK EL DIAG: OK`), or after `AZ/EL` for both.

    By axis; NoReply (garbage) unless both are there.
    """
    text = " ".join(reply.lines)
    both = _BOTH.search(text)
    spelt = {word.lower(): word for word in words}
    found = {}
    for axis, part in ((AZIMUTH, both or _AZ.search(text)), (ELEVATION, both or _EL.search(text))):
        told = [spelt[word.lower()] for word in _WORD.findall(part[1] if part else "") if word.lower() in spelt]
        if not told:
            raise garbage(reply)
        found[axis] = told[0]
    return found
