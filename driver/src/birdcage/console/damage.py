"""What the wire can make of a text: bytes lost and doubled (docs/decisions/0003-q-in-step.md)."""

from __future__ import annotations


def may_become(sent: str, seen: str) -> bool:
    """Return whether bytes lost and doubled can make `seen` of what was sent."""
    at, uses = -1, 2
    for letter in seen:
        if uses == 1 and sent[at] == letter:
            uses = 2
            continue
        at, uses = sent.find(letter, at + 1), 1
        if at < 0:
            return False
    return True
