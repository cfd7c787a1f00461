"""What the author of a machine supplies: a simulated twin of it, whose mechanics can be asked for the truth."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.link import Link
from birdcage.rotator.rotator import Rotator


@dataclass(frozen=True, slots=True)
class Truth:
    """What the mechanics do at this moment, whatever the machine says of it. The machine's own degrees."""

    az_deg: float
    el_deg: float
    moving: bool


@dataclass(frozen=True, slots=True)
class SeenCommand:
    """Something that reached the machine and sets axes in motion."""

    at: float
    """Monotonic seconds."""
    motors: frozenset[int]
    """The axes that it names, by motor number."""


class Twin(ABC):
    """One simulated machine on a virtual clock. `address` is the port under which the machine finds it."""

    address = "twin"

    @abstractmethod
    def truth(self) -> Truth:
        """Return what the mechanics do now."""

    @abstractmethod
    def taken(self) -> Sequence[SeenCommand]:
        """Return every command of a move that has reached the machine, oldest first."""

    @abstractmethod
    def received(self) -> int:
        """Return how many lines, packets or calls of any kind have reached the machine."""

    @abstractmethod
    def unplug(self) -> None:
        """Take the line away: opening it again fails until `plug`. A motion under way goes on."""

    @abstractmethod
    def plug(self) -> None:
        """Put the line back."""

    @abstractmethod
    def mute(self) -> None:
        """Have the machine neither hear nor answer from now on, with the line in place."""

    @abstractmethod
    def unmute(self) -> None:
        """Have it hear and answer again."""

    def dial(self, address: str, baud: int) -> Link:  # noqa: ARG002 - for machines that speak over bytes
        """Open a line of bytes to it. LinkError where there is none."""
        raise LinkError(f"{address} has no line of bytes.", reason=Reason.MISSING)

    def is_wrecked(self) -> bool:
        """Return whether a byte that must never be sent has reached it: the root prompt's `q`, say."""
        return False


@dataclass(frozen=True, slots=True)
class StopScene:
    """How to see one rung of the ladder at work."""

    rung: str
    """As it stands in `StationState.last_stop.means`."""
    way_deg: tuple[float, float]
    """How far azimuth and elevation are sent; the signs are chosen so that the target is allowed."""
    after_s: float = 1.0
    """When STOP comes, from the request on."""
    reaches_target: bool = False
    """Whether the motion ends at its target all the same: nothing calls it back."""
    confirmed: bool | None = True
    """What STOP may claim in the end, of a machine that tells its position."""
    twin: Callable[[VirtualClock], Twin] | None = None
    """Another twin than the bench's own: one on which the rungs above do not work."""
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Fields of `StationSettings`: the consent that this rung needs."""
    begin: tuple[float, float] | None = None
    """Where the machine is sent before, if its twin begins where there is no room for the way."""
    again_deg: tuple[float, float] | None = None
    """A second target, sent this far from the first one at once; for rungs that only a second move brings about."""


@dataclass(frozen=True, slots=True)
class ConsoleScene:
    """What a person types into the raw console, and what has to come of it."""

    ask: str
    """A line that asks something and changes nothing."""
    answer: str
    """What its answer holds."""
    moves: str
    """A line that moves the machine: refused while it is HELD."""
    ends: tuple[str, ...] = ()
    """Lines, sent one after the other, of which the last would end the console where it would stand then. Empty if no
    line does."""


@dataclass(frozen=True, slots=True)
class Golden:
    """One recorded conversation: what the driver must send, byte for byte, and what it must make of the answers."""

    name: str
    exchanges: tuple[tuple[bytes, bytes], ...]
    """What is sent, and what the machine then prints."""
    act: Callable[[Rotator], object]
    result: object


@dataclass(frozen=True, slots=True)
class MachineBench:
    """A machine with its twin: what every case of the contract is given."""

    machine: str
    """The name under which `birdcage.rotator.machines` finds it."""
    twin: Callable[[VirtualClock], Twin]
    stops: tuple[StopScene, ...]
    """One for each rung of `Facts.stop_ladder` that a program can climb."""
    console: ConsoleScene | None = None
    """None for a machine without a raw console (`Rotator.raw` is None)."""
    goldens: tuple[Golden, ...] = ()
    frail: Callable[[VirtualClock], Twin] | None = None
    """A twin that a byte can end at its root prompt (`is_wrecked`), where there is such a byte."""
    near_deg: float = 0.1
    """How far from its target the machine may come to rest."""
    ready_s: float = 20.0
    """How long it takes at most from opening the line to everything read."""
    follows_deg: float = 0.1
    """How much worse than the plan foresees a pass may be followed: overshoot, play and reading, which no plan has."""
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Fields of `StationSettings` for every case."""
