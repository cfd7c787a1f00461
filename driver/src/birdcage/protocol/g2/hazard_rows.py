"""Makes rows of the G2's hazard table, a word for each grade."""

from __future__ import annotations

import re

from birdcage.protocol.hazard import Hazard
from birdcage.rotator.verdict import Grade

WHERE = frozenset({"position", "turn"})
REFERENCE = frozenset({"position", "turn", "homed"})
ALL = frozenset({"position", "turn", "homed", "limits", "search", "settings"})
DEADLOCK = (
    "The dish is not known to be homed: its target may be 2147483647, and its shell then waits for ever. "
    "Only a power cycle ends that. Home it first."
)


def rows(
    menus: str | frozenset[str],
    grade: Grade,
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = frozenset(),
    takes_s: float = 0.0,
    streams: bool = False,
    homes: tuple[int, ...] = (),
    restarts: bool = False,
    unhomed: bool = False,
    releases: bool = False,
) -> tuple[Hazard, ...]:
    """Return one row for each pattern; the rest is as in `Hazard`."""
    where = frozenset(menus.split()) if isinstance(menus, str) else menus
    return tuple(
        Hazard(
            where,
            re.compile(pattern),
            grade,
            consequence,
            forgets,
            takes_s,
            streams,
            homes,
            restarts,
            unhomed,
            releases,
        )
        for pattern in patterns
    )


def harmless(menus: str | frozenset[str], *patterns: str, takes_s: float = 0.0) -> tuple[Hazard, ...]:
    """Return rows of what changes nothing."""
    return rows(menus, Grade.HARMLESS, "", *patterns, takes_s=takes_s)


def streams(menu: str, *patterns: str) -> tuple[Hazard, ...]:
    """Return rows of what prints until a key."""
    return rows(menu, Grade.HARMLESS, "", *patterns, streams=True)


def setting(
    menus: str, consequence: str, *patterns: str, forgets: frozenset[str] = frozenset(), takes_s: float = 0.0
) -> tuple[Hazard, ...]:
    """Return rows of what changes a setting."""
    return rows(menus, Grade.SETTING, consequence, *patterns, forgets=forgets, takes_s=takes_s)


def moves(
    menus: str,
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = WHERE,
    takes_s: float = 0.0,
    homes: tuple[int, ...] = (),
) -> tuple[Hazard, ...]:
    """Return rows of what moves the dish."""
    return rows(menus, Grade.MOVES, consequence, *patterns, forgets=forgets, takes_s=takes_s, homes=homes)


def ruins(
    menus: str | frozenset[str],
    consequence: str,
    *patterns: str,
    forgets: frozenset[str] = frozenset(),
    takes_s: float = 0.0,
    unhomed: bool = False,
) -> tuple[Hazard, ...]:
    """Return rows of what may ruin the dish or deadlock its shell."""
    return rows(
        menus, Grade.RUINS, consequence, *patterns, forgets=forgets, takes_s=takes_s, unhomed=unhomed
    )  # fmt: skip
