"""What a face asks for while somebody holds the key of a motor."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Run:
    """Have a motor run without a target while this is asked for again: within 1 s at first, then within 0.6 s.

    Then STOP is sent, and so it is before a limit, at `EndMotion`, and whenever its holder loses control.
    CommandRefused (`unsupported`) for a feature that is not `HELD`. MotionRefused as for any motion. ConfirmationNeeded
    until a person has agreed to its hazard.
    """

    feature: str
    """Its id."""
    value: float
    holder: str
    agreed: bool = False
    """Whether a person was told the feature's `hazard`, and agreed."""
    renews: bool = False
    """Whether the key was held before: a run that has ended meanwhile does not begin anew by this."""
