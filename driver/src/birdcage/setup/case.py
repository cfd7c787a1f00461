"""A port that does not answer, and what may be the cause: the words of the walk through the causes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.detection.probe import BaudFinding, Saw
from birdcage.station.known import PortInfo, SystemFacts, has_speed
from birdcage.station.state import LinkState


@dataclass(frozen=True, slots=True)
class Cause:
    """One thing that may be wrong."""

    title: str
    why: str
    """What was seen, and why that speaks for it."""
    what_to_do: str
    likely: bool
    use_baud: int | None = None
    """The rate that mends it, where a rate does: `Connect` with it."""
    command: str = ""
    """What to type in a shell, where that mends it."""


@dataclass(frozen=True, slots=True)
class Case:
    """All that is known of a port that does not answer."""

    port: str
    """As it was asked for: a device or a URL."""
    link: LinkState
    findings: tuple[BaudFinding, ...] = ()
    """What `ProbePort` saw, the present rate first; empty before it was asked."""
    system: SystemFacts | None = None
    ports: tuple[PortInfo, ...] = ()
    """The ports that there are now."""
    restarted: bool = False
    """Whether the boot text of the dish has come, and is not acknowledged yet."""
    firmware_baud: int | None = None
    """The rate of the firmware that was chosen; None if none was."""
    boot_s: float | None = None
    """The longest that its boot takes; None if it is not known which one it is."""

    @property
    def answered_before(self) -> bool:
        """Whether the dish has answered since the program started: then the wires were right."""
        return self.link.last_reply is not None

    @property
    def patience(self) -> str:
        """How long a dish that starts is waited for, in words."""
        minutes = 3 if self.boot_s is None else max(1, round(self.boot_s / 60))
        return {3: "three minutes", 15: "fifteen minutes"}.get(minutes, f"{minutes} minutes")

    @property
    def sets_rate(self) -> bool:
        """Whether the baud rate is ours to set: on TCP it is the server's."""
        return has_speed(self.port)

    @property
    def seen(self) -> str:
        """What was seen, in a sentence: its meaning is what the causes are for."""
        first, stop, _ = self.link.detail.partition(". ")
        return f"{first}." if stop else first

    def rates(self, saw: Saw) -> tuple[int, ...]:
        """Return the rates at which this was seen."""
        return tuple(each.baud for each in self.findings if each.saw is saw)


def describe(findings: Sequence[BaudFinding]) -> str:
    """Return what was seen as one line: `115200: silence; 57600: 34 bytes, garbage`."""
    return "; ".join(f"{each.baud}: {_told(each)}" for each in findings)


def _told(finding: BaudFinding) -> str:
    match finding.saw:
        case Saw.SILENCE:
            return "silence"
        case Saw.GARBAGE:
            return f"{finding.count} byte{'' if finding.count == 1 else 's'}, garbage"
        case Saw.ECHO:
            return "own echo"
        case Saw.TEXT:
            return f"text `{finding.sample}`"
        case Saw.PROMPT:
            return f"prompt `{finding.sample}`"
