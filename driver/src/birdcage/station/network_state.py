"""Who reaches the dish over the network: what a server of Hamlib's protocol shows of itself and of its clients."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum


class NetworkRole(StrEnum):
    """What a client's wishes come to."""

    CONTROL = "control"
    """It has control: its wishes move the dish."""
    IGNORED = "ignored"
    """It sends wishes that are not carried out: somebody else has control, the dish is HELD, or it may only look."""
    WATCHES = "watches"
    """It has not asked for a motion."""


class NetworkProgram(StrEnum):
    """Which program a client seems to be, by how it talks."""

    GPREDICT = "Gpredict"
    HAMLIB = "Hamlib"
    SATNOGS = "SatNOGS"
    SATDUMP = "SatDump"
    SDRANGEL = "SDRangel"
    LOOK4SAT = "Look4Sat"
    UNKNOWN = ""


@dataclass(frozen=True, slots=True)
class NetworkLine:
    """One command of a client, and what it was answered."""

    utc: datetime
    command: str
    reply: str
    """Its lines joined by blanks; empty while the answer is due, or where there is none."""


@dataclass(frozen=True, slots=True)
class NetworkClient:
    """One client."""

    number: int
    """Counted from 1 since the server began."""
    name: str
    """Under which it holds control."""
    program: NetworkProgram
    address: str
    """`192.168.1.5:51234`."""
    since: datetime
    role: NetworkRole = NetworkRole.WATCHES
    wants_az_deg: float | None = None
    """Its last wish, true; None if it has none."""
    wants_el_deg: float | None = None
    last_command: str = ""
    last_utc: datetime | None = None
    commands: int = 0
    errors: int = 0
    """How many of them were answered with an error."""
    ignored: int = 0
    """How many wishes were not carried out."""
    why: str = ""
    """Why the last of them was not, as a sentence; empty while its wishes are carried out."""
    shut_out: bool = False
    """Whether a person has its wishes ignored."""
    waits: bool = False
    """Whether its wish waits for the link to come back."""
    stale: bool = False
    """Whether it is told the last position of a dish that is out of sight."""
    lead_s: float | None = None
    """By how much the dish leads its wishes, which are a stream, in seconds; None while they are sent as they are.

    Less than 0 on trial: the dish follows, and it is not known yet whether the wishes themselves lead.
    """
    follows: str = ""
    """The satellite that it was recognised to follow, and that the dish follows by a plan; empty for none."""
    follow_error_deg: float | None = None
    """How far off the dish was by that plan, RMS on the sky; None before it was looked at on the target."""
    steps_error_deg: float | None = None
    """How far off the steps of its wishes would have left the dish, RMS on the sky; None while none is followed."""
    lines: tuple[NetworkLine, ...] = ()
    """The last of what was said, oldest first: up to 50, fewer where there are many clients."""

    @property
    def label(self) -> str:
        """What to call it: its program where that is known, else its name."""
        return f"{self.program} ({self.name})" if self.program else self.name


@dataclass(frozen=True, slots=True)
class NetworkState:
    """The server. Where none runs, `StationState.network` is None."""

    host: str
    port: int
    read_only: bool = False
    strict: bool = False
    clients: tuple[NetworkClient, ...] = ()
    """In the order in which they came."""
    turned_away: int = 0
    """How many were not let in: not in an allowed network, or too many."""
    recognises: bool = False
    """Whether satellites are recognised that clients follow."""
    recognises_why_not: str = ""
    """What is missing for that, in a few words; empty for nothing."""
    by: str = ""
    """Which attached program serves: `birdcage serve, anna (pts/3)`. Empty where the station's own program does."""

    @property
    def address(self) -> str:
        """Where it listens: `127.0.0.1:4533`."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"
