"""What can go wrong with a receiver. None of it concerns the dish: a pass goes on without."""

from __future__ import annotations

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason

MEANINGS = {
    -1: "a value that it does not take",
    -4: "it does not know that",
    -5: "its radio does not answer it",
    -6: "it cannot reach its radio",
    -8: "it does not understand its radio",
    -9: "its radio refuses",
    -11: "its radio cannot do that",
    -18: "it does not do that any more",
    -20: "its radio is switched off",
    -21: "a value outside of its range",
}
"""Hamlib's own codes (`rig_errcode_e` of its `rig.h`). SDR++ and gqrx say 1 to all that they do not know."""


class RadioLost(BirdcageError):
    """The conversation is over: what comes next on this connection would be out of step.

    Reasons: missing (nothing listens there), silent, closed, garbage.
    """

    reason = Reason.SILENT


class RadioRefused(BirdcageError):
    """It understood, and did not do it. `code` is the number behind RPRT."""

    reason = Reason.REFUSED

    def __init__(self, command: str, code: int) -> None:
        meaning = MEANINGS.get(code, "")
        super().__init__(f"It answers {command!r} with RPRT {code}{f': {meaning}' if meaning else ''}.")
        self.code = code
