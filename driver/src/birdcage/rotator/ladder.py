"""The ladder that STOP climbs: what each rung does, and whether that is proven."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum


@dataclass(frozen=True, slots=True)
class Rung:
    """One rung of the ladder that STOP climbs, known before each move."""

    name: str
    """`retarget`, `abort` (of a silent slew), `end of move`, `release` or `power`."""
    proven: bool
    """Whether a source documents that it works on this firmware."""
    sentence: str
    loses_position: bool = False
    needs_consent: bool = False
    """Used only if the user enabled it in `birdcage.toml`."""


END_OF_MOVE = Rung(
    "end of move", proven=True, sentence="a move of one axis cannot be called back; it stops at its target"
)
POWER_SWITCH = Rung("power", proven=True, sentence="the power of the dish is cut, by hand", loses_position=True)


class StopBy(Enum):
    """What is written at once when STOP is called."""

    RETARGET = "retarget"
    """A new target just ahead of where it is."""
    ABORT = "abort"
    """What ends a silent slew."""
    KNOCK = "knock"
    """Something that moves nothing, and brings an answer: it tells what was read until then."""


@dataclass(frozen=True, slots=True)
class StopOrder:
    """One of them, and where to come to rest."""

    by: StopBy
    aim_deg: Mapping[str, float] = field(default_factory=dict)
    """By the name of the axis, for a retarget."""
