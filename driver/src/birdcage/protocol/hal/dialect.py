"""How the consoles of the Trav'lers look (`docs/reference/travler.md`, *Prompts and menus*): prompts are learnt."""

from __future__ import annotations

import re

from birdcage.base.reason import Reason
from birdcage.console.dialect import UNKNOWN_TOKEN, ConsoleDialect
from birdcage.protocol.family import AXIS_NAMES, MOTOR_TROUBLES
from birdcage.protocol.hal.variant import NVS, VARIANTS, HalVariant

GAP_S = 1.0
"""How long the program for the Trav'ler Pro waits after a line (`docs/reference/travler-pro.md`, *Pace*)."""
MOTOR_GAP_S = 0.2
"""Among its motors that program waits for nothing; a fifth of a second costs little."""
_MARKS = {"s": frozenset({"s"}), "kill Search": frozenset({"tasks", "kill"})}
"""What the help of the menu lists in which the TV search is ended, by the line that ends it."""
_REFUSALS = (
    (re.compile(r"\b(invalid|unknown|unrecognized|bad) command\b", re.IGNORECASE), Reason.UNKNOWN_COMMAND),
    (
        re.compile(r"\b(invalid|bad|illegal)\b.*\b(parameter|argument|value|motor|angle)\b", re.IGNORECASE),
        Reason.BAD_PARAMETER,
    ),
    (re.compile(r"\b(out of range|outside|limit exceeded)\b", re.IGNORECASE), Reason.BAD_PARAMETER),
    (
        re.compile(r"^\s*(error|failed)\b|\bSTALLED\b|\bHome Failure\b|\bnot (calibrated|homed)\b", re.IGNORECASE),
        Reason.FAILED,
    ),
)
"""No source has the texts of these firmwares, but for their stalls (`docs/reference/travler.md`, *Faults*): words."""


def dialect_of(variant: HalVariant) -> ConsoleDialect:
    """Return the console of one of the Trav'lers."""
    tunnel = {variant.home} - {"root"}
    return ConsoleDialect(
        troubles=MOTOR_TROUBLES,
        axis_names=AXIS_NAMES,
        prompts=dict.fromkeys(("root", *tunnel, *variant.submenus), UNKNOWN_TOKEN),
        parents={menu: variant.home for menu in variant.submenus if tunnel},
        one_way=frozenset(tunnel),
        gap_s=GAP_S if tunnel else 0.0,
        gaps_s={variant.motor: MOTOR_GAP_S} if tunnel else {},
        root_marks=variant.root_marks,
        root_is_own=variant.root_is_own,
        root_hints=frozenset(tunnel or {*variant.submenus, "motor", "mot", "os", "reboot", "stow"}),
        submenu_marks={
            **{menu: frozenset({variant.motor, NVS}) for menu in tunnel},
            variant.motor: frozenset({"a", "g"}),
            variant.search: _MARKS[variant.end_search],
            NVS: frozenset({"d", "e", "s"}),
        },
        proofs={variant.motor: ("a", re.compile(r"\bAZ\s*=\s"))},
        stranger_marks=variant.unlike,
        foreign_marks=variant.foreign,
        stranger=(
            "This dish answers like another firmware (prompt `{prompt}`), not like "
            f"{variant.label}. `birdcage detect` names it: a Carryout G2 is --firmware g2, a Trav'ler with HAL 0.0.00 "
            "hal000, one with HAL 2.05 hal205, a Trav'ler Pro pro. Nothing was moved."
        ),
        refusals=_REFUSALS,
    )


DIALECTS = {variant.firmware: dialect_of(variant) for variant in VARIANTS}
