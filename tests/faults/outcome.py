"""What came of one ordeal."""

from __future__ import annotations

from dataclasses import dataclass


def readable(data: bytes) -> str:
    """Return what went out, with a mark for Enter."""
    return data.decode("latin-1").replace("\r", "↵")


@dataclass(frozen=True, slots=True)
class Stopping:
    """What STOP did in the middle of the fault."""

    sends: str
    """When its own bytes left the port: `at once`, before the call came back; `after a look`; or `nothing`."""
    at_call: str
    means: str
    reported: str
    confirmed: bool | None
    escaped: tuple[str, ...]
    """Motion lines that left the port in the minute after it, STOP's own apart: none may."""
    rests: bool
    """Whether the dish stood still at the end of that minute."""
    held: bool


@dataclass(frozen=True, slots=True)
class Outcome:
    """What was seen, done and true in one cell of the matrix."""

    sees: tuple[str, ...]
    """Sentences of the state, in their order."""
    links: tuple[str, ...]
    fault: str | None
    alarms: tuple[str, ...]
    """The reason of every fault that was shown."""
    held: str | None
    motion: str
    """What became of the motion: `arrives`, the reason of its error, or `-` where none was asked for."""
    position_hidden: bool
    """Whether the position was given up while the fault lasted."""
    came_back_s: float | None
    """How long after the healing the dish answered and was settled; None if not."""
    deeds: tuple[str, ...]
    """What a person had to do before the next motion."""
    next_good: str
    """`right`, or what was wrong with the next exchange and motion."""
    false: tuple[str, ...]
    """What was told and was not so: nothing may be."""
    unasked: tuple[str, ...]
    """Lines that moved the dish, and places where it went, unasked."""
    misled: bool
    """Whether a modelled position stood there that was wrong, while the fault lasted or right after it."""
    stop: Stopping
