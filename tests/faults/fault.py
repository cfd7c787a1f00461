"""What a fault is, as data; the rows are in `wire_faults` and `dish_faults`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from birdcage.station.requests import Goto, TurnSkew

if TYPE_CHECKING:
    from .stage import Stage

DIALECTS = ("g2", "g2plus", "hal205", "hal000", "pro", "easycomm")
"""Those that tell where they point."""
TIMED = ("pathway-x1", "pathway-x2")
"""Those that do not: where they point is modelled, and marked so (docs/decisions/0043)."""
CONSOLES = (*(each for each in DIALECTS if each != "easycomm"), *TIMED)
"""Those with prompts, menus and an echo."""
REST, MOVING = "at rest", "in mid-move"
ANY = "at once|after a look|nothing"
"""Where nothing is known to move, STOP may have nothing to send, and looks."""

START = dict.fromkeys((*DIALECTS, *TIMED), (90.0, 25.0))
FAR = dict.fromkeys((*DIALECTS, *TIMED), (230.0, 55.0))
"""Where the move that the fault meets begins, and where it goes: both axes, for ten seconds and more."""


def nothing(stage: Stage) -> None:
    """Do nothing."""


def far(stage: Stage) -> Goto:
    """Move both axes."""
    return Goto(*FAR[stage.dialect], "you")


def skew(stage: Stage) -> TurnSkew:
    """Move the skew alone."""
    return TurnSkew(170.0, "you")


@dataclass(frozen=True, slots=True)
class Expect:
    """What is particular to a fault, as words with `|` between those that may be; `-` is none.

    What is the same for all of them the test asserts by itself.
    """

    link: str = "-"
    """The worst state of the link that is told: `silent` or `lost`."""
    fault: str = "-"
    """The reason of the fault that is shown."""
    held: str = "-"
    """Why the station holds."""
    motion: str = "-"
    """What became of the motion that was under way: `arrives`, or the reason of its error."""
    stop: str = ""
    """`at once`, `after a look`, `nothing`: when STOP's bytes leave. Empty: at once in a motion with a port."""
    misled: bool = False
    """Whether a modelled position stands that is wrong, as nothing tells."""


def timed(*where: str, **fields: Any) -> dict[str, Expect]:
    """Return what is particular to it on dishes that do not tell: `x1 at rest`, and so on."""
    return {f"pathway-{each}": Expect(**fields) for each in where}


@dataclass(frozen=True, slots=True)
class Fault:
    """One kind of bad day. `inflict`, `again` and `heal` get the stage."""

    name: str
    title: str
    """For the table."""
    inflict: Callable[[Stage], None]
    heal: Callable[[Stage], None] = nothing
    again: Callable[[Stage], None] = nothing
    """Called ten times a second while it lasts."""
    expect: Mapping[str, Expect] = field(default_factory=dict)
    """By moment; `dialect moment` goes before it."""
    motion: Callable[[Stage], object] = far
    """What is asked for in mid-move."""
    before: bool = False
    """Inflict before the move is asked for: the dish meets it on its way."""
    lasts_s: Mapping[str, float] = field(default_factory=lambda: {REST: 8.0, MOVING: 30.0})
    """Longer than the move."""
    strikes_s: float = 1.5
    """How long after the beginning of the move."""
    dialects: tuple[str, ...] = DIALECTS
    options: Mapping[str, str] = field(default_factory=dict)
    """More of the simulated dish's address, by dialect."""
    own_motion: bool = False
    """Whether the dish then moves by itself."""
    astray: bool = False
    """Whether the dish goes where it was not sent, as the command that reaches it is another."""
    port: bool = True
    """Whether there is a port while it lasts, for STOP's bytes to leave by."""

    def meets(self, dialect: str, when: str) -> bool:
        """Return whether it is inflicted on a dialect then: on one that does not tell, where `expect` names that."""
        return f"{dialect} {when}" in self.expect if dialect in TIMED else dialect in self.dialects

    @property
    def moments(self) -> tuple[str, ...]:
        """When it is inflicted: at the moments that say what is to be expected there."""
        return tuple(when for when in (REST, MOVING) if any(key.endswith(when) for key in self.expect))

    def expected(self, dialect: str, when: str) -> Expect:
        """Return what is particular to it, there and then."""
        return self.expect.get(f"{dialect} {when}") or self.expect[when]
