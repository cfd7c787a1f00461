"""Which firmware a console is, by what it shows: prompts, listed commands, words of a boot log.

Each clue speaks *for* a firmware. What no clue speaks for is none of those that are spoken here: that a console is not
one of them never makes it another. What a rate lets be read is no clue either, but a prompt counts only at the rate of
its firmware, as other consoles may show the same.

Every dialect that is found by entry point takes part, anybody's, with what its class tells of it: `model`, `dialect`,
`motor_menu` and `log_marks` (see `FirmwareProtocol`). A whole machine does by its `probe` (`LineProbe`). One that tells
neither has to be named by a person.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.detection.machine_probe import answered, marked_lines
from birdcage.detection.probe import BaudFinding, Saw
from birdcage.detection.spoken import marked
from birdcage.protocol.protocol import FirmwareProtocol

CERTAIN, LIKELY = 2, 1


@dataclass(frozen=True, slots=True)
class Clue:
    """Something that was seen, and the firmware that shows it."""

    firmware: str
    words: str
    """What was seen: `prompt `TRK>` at 115200 baud`."""
    weight: int
    """`CERTAIN` where no other console is known to show it, else `LIKELY`."""


def clues_of(finding: BaudFinding, *, rate_counts: bool = True) -> tuple[Clue, ...]:
    """Return what in a finding speaks for which firmware; `rate_counts`: whether the port takes its rate from us."""
    found: list[Clue] = []
    for name, protocol in marked().items():
        own_rate = not rate_counts or protocol.model.any_baud or finding.baud == protocol.model.baud
        at = f" at {finding.baud} baud" if rate_counts else ""
        found += [Clue(name, words, weight) for words, weight in _clues(finding, protocol, at, own_rate=own_rate)]
    if finding.saw is Saw.TEXT:
        told = answered(finding)
        found += [Clue(name, words, CERTAIN) for name, words in told]
        found += [Clue(name, f"`{mark}` in what it prints", LIKELY) for name, mark in marked_lines(finding) if not told]
    return tuple(found)


def firmwares_of(clues: Sequence[Clue]) -> tuple[str, ...]:
    """Return the firmwares for which the most certain clues speak; more than one cannot be told apart."""
    weight = max((clue.weight for clue in clues), default=0)
    return tuple(dict.fromkeys(clue.firmware for clue in clues if clue.weight == weight))


def _clues(
    finding: BaudFinding, protocol: type[FirmwareProtocol], at: str, *, own_rate: bool
) -> list[tuple[str, int]]:  # fmt: skip
    dialect = protocol.dialect
    found: list[tuple[str, int]] = []
    if finding.listed & dialect.foreign_marks:
        return found
    own = finding.listed & dialect.own_marks
    if dialect.root_marks and dialect.root_marks <= finding.listed:
        if dialect.root_is_own or own_rate:
            weight = CERTAIN if dialect.root_is_own else LIKELY
            found.append((f"`?` lists {_names(dialect.root_marks)}", weight))
    elif own:
        found.append((f"`?` lists {_names(own)}", CERTAIN))
    elif own_rate:
        found += [
            (f"`?` lists {_names(marks)} as its menu `{menu}` does", LIKELY)
            for menu, marks in dialect.submenu_marks.items()
            if menu in (protocol.motor_menu, *dialect.one_way)
            and marks <= finding.listed
            and not _is_said_better(marks, finding.listed)
        ]
    if not own_rate:
        return found
    if finding.prompt in _tokens(protocol):
        found.append((f"prompt `{finding.prompt}`{at}", LIKELY))
    if finding.saw in (Saw.TEXT, Saw.PROMPT):
        found += [(f"`{mark.strip()}` in its log{at}", LIKELY) for mark in protocol.log_marks if mark in finding.text]
    return found


def _is_said_better(marks: frozenset[str], listed: frozenset[str]) -> bool:
    """Return whether another firmware's motor menu lists these commands and more, and all of them are there."""
    return any(
        marks < others <= listed
        for protocol in marked().values()
        for menu, others in protocol.dialect.submenu_marks.items()
        if menu == protocol.motor_menu
    )


def without_rate(clues: Sequence[Clue], *, answers: bool) -> tuple[Clue, ...]:
    """Return the clues that are left once the port was tried at another rate: whether what is there answers there too.

    What is certain stays, as the trial may have been in vain.
    """
    free = {name for name, protocol in marked().items() if protocol.model.any_baud}
    return tuple(clue for clue in clues if clue.weight == CERTAIN or (clue.firmware in free) is answers)


def depends_on_rate(firmwares: Sequence[str]) -> bool:
    """Return whether some of these answer at every rate, and some at their own alone: another rate tells them apart."""
    spoken = marked()
    return len({spoken[name].model.any_baud for name in firmwares if name in spoken}) > 1


def known_tokens() -> tuple[str, ...]:
    """Return every prompt that a firmware declares."""
    return tuple(token for protocol in marked().values() for token in _tokens(protocol))


def _tokens(protocol: type[FirmwareProtocol]) -> tuple[str, ...]:
    """Return the prompts that are known of a firmware; a prompt that has to be learnt is none."""
    return tuple(token for token in protocol.dialect.prompts.values() if token)


def _names(commands: frozenset[str]) -> str:
    return ", ".join(f"`{command}`" for command in sorted(commands))
