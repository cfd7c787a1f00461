"""The ladder that STOP climbs: what each rung does, to which motions, and whether that is proven."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, StrEnum


class MoveKind(Enum):
    """Motions that are stopped in ways of their own."""

    SINGLE = "single"
    """Of axes that were each sent by themselves: go-tos, steps, and the targets of a stream."""
    COMBINED = "combined"
    """Of all axes, sent at once."""
    HOME = "home"
    STOW = "stow"
    SEARCH = "search"
    """For TV satellites, of its own accord."""
    SWEEP = "sweep"
    """Along an axis, by the machine itself (`Facts.sweep`)."""


EVERY_MOVE = frozenset(MoveKind)


class StopMeans(StrEnum):
    """By what STOP ends a motion: the means of a rung, or what it has come to instead."""

    RETARGET = "retarget"
    """A new target just ahead of where it is."""
    ABORT = "abort"
    """A byte that ends a combined move."""
    COMMAND = "command"
    """The machine's own command for it."""
    KEY = "key"
    """A key, which may end what the machine does by itself."""
    WAIT = "end of move"
    """Nothing ends it: it stops at its target, and nothing follows it."""
    RELEASE = "release"
    """The current is taken off the motors."""
    POWER = "power"
    """A person switches the machine off."""
    SEARCH = "search"
    """A TV search was ended."""
    LOOK = "look"
    """Two readings must tell first where to aim, or that nothing moves."""
    NOTHING_MOVED = "nothing moved"
    NO_LINK = "no link"
    """Nothing could be sent."""
    NONE = "none"
    """Nothing that is known ends it."""

    @property
    def is_sent(self) -> bool:
        """Whether something goes to the machine that is to end a motion by itself."""
        return self in (StopMeans.RETARGET, StopMeans.ABORT, StopMeans.COMMAND, StopMeans.KEY, StopMeans.SEARCH)

    @property
    def is_undecided(self) -> bool:
        """Whether readings must still tell what is to be done."""
        return self in (StopMeans.LOOK, StopMeans.NOTHING_MOVED)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rung:
    """One rung of the ladder that STOP climbs, known before each move."""

    means: StopMeans
    ends: frozenset[MoveKind]
    proven: bool
    """Whether a source documents that it works on such machines."""
    sentence: str
    """What it does, for a person."""
    anywhere: bool = False
    """Whether it works in every menu, and whatever the machine is busy with."""
    lasts_s: float | None = None
    """How long it takes at the longest; None: as long as braking does."""
    loses_position: bool = False
    needs_consent: bool = False
    """Used only if the user enabled it in `birdcage.toml`."""

    @property
    def ends_what_it_is_busy_with(self) -> bool:
        """Whether it is known to end a motion during which the machine reads nothing else."""
        return self.proven and self.anywhere and self.means in (StopMeans.COMMAND, StopMeans.ABORT)


END_OF_MOVE = Rung(
    means=StopMeans.WAIT, ends=frozenset({MoveKind.SINGLE}), proven=True,
    sentence="a move of one axis cannot be called back; it stops at its target",
)  # fmt: skip
POWER_SWITCH = Rung(
    means=StopMeans.POWER, ends=EVERY_MOVE, proven=True, sentence="the power of the dish is cut, by hand",
    loses_position=True,
)  # fmt: skip


def rungs(ladder: tuple[Rung, ...], kind: MoveKind, *, consent: bool) -> tuple[Rung, ...]:
    """Return the rungs that end a kind of motion, best first; those that need `consent` only with it."""
    return tuple(rung for rung in ladder if kind in rung.ends and (consent or not rung.needs_consent))


class StopBy(Enum):
    """What is written at once when STOP is called."""

    RETARGET = "retarget"
    """A new target just ahead of where it is."""
    ABORT = "abort"
    """What ends a combined move."""
    COMMAND = "command"
    """What the machine itself has for it."""
    KNOCK = "knock"
    """Something that moves nothing, and brings an answer: it tells what was read until then."""


@dataclass(frozen=True, slots=True)
class StopOrder:
    """One of them, and where to come to rest."""

    by: StopBy
    aim_deg: Mapping[str, float] = field(default_factory=dict)
    """By the name of the axis, for a retarget."""
