"""What the faces show of one client's wishes."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class ClientRole(StrEnum):
    """What a client is to the dish now."""

    CONTROL = "control"
    """It has the lease: its wishes move the dish."""
    IGNORED = "ignored"
    """It wishes, and its last wish was not carried out."""
    WATCHES = "watches"
    """It only looks."""


@dataclass(frozen=True, slots=True)
class WishedDirection:
    """A direction that a client asked for, folded to what can be pointed at: true degrees."""

    az_deg: float
    """0 to 360."""
    el_deg: float
    """-90 to 90."""

    def is_as(self, other: WishedDirection | None) -> bool:
        """Return whether both are the same direction, to the hundredth in which commands are written."""
        return other is not None and self.hundredths == other.hundredths

    @property
    def hundredths(self) -> tuple[int, int]:
        """Azimuth and elevation as they are told apart."""
        return round(self.az_deg * 100.0) % 36_000, round(self.el_deg * 100.0)


@dataclass(frozen=True, slots=True)
class Following:
    """A satellite that a client wishes for, and the dish follows by a plan of its own."""

    name: str
    error_deg: float | None
    """How far off the dish was, RMS on the sky; None before it was looked at on the target."""
    steps_deg: float
    """How far off a dish was that went by the client's own steps, RMS on the sky."""


@dataclass(frozen=True, slots=True)
class ClientView:
    """One client at one moment."""

    name: str
    """By which it holds control."""
    role: ClientRole
    wish: WishedDirection | None
    """What it asked for last; None if it asked for nothing yet, or has taken that back."""
    wished_at: float | None
    """When that was; monotonic seconds."""
    ignored: int
    """How many of its wishes were not carried out."""
    why: str
    """Why the last of them was not, as a sentence; empty while its wishes are carried out."""
    told: tuple[float, float] | None
    """The azimuth and elevation that it was told last; None if it has not asked, or they were not known."""
    waits: bool
    """Whether its wish waits for the link to come back."""
    stale: bool
    """Whether it is told the last position, of a dish that is out of sight."""
    shut_out: bool = False
    """Whether a person has its wishes ignored."""
    lead_s: float | None = None
    """By how much the dish leads its wishes, which are a stream, in seconds; None while they are sent as they are.

    Less than 0 on trial: the dish follows, and it is not known yet whether the wishes themselves lead.
    """
    following: Following | None = None
    """The satellite that the dish follows by a plan of its own, as the wishes agree with it; None for none."""
