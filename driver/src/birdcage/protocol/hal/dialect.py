"""How the console of HAL 2.05 looks (`docs/reference/travler.md`, *Prompts and menus*): its prompts are learnt."""

from __future__ import annotations

import re

from birdcage.base.reason import Reason
from birdcage.console.dialect import UNKNOWN_TOKEN, ConsoleDialect
from birdcage.protocol.family import AXIS_NAMES, MOTOR_TROUBLES

MOTOR, SEARCH, NVS = "motor", "ngsearch", "nvs"

DIALECT = ConsoleDialect(
    troubles=MOTOR_TROUBLES,
    axis_names=AXIS_NAMES,
    prompts=dict.fromkeys(("root", MOTOR, SEARCH, NVS), UNKNOWN_TOKEN),
    root_marks=frozenset({MOTOR, SEARCH}),
    root_hints=frozenset({MOTOR, SEARCH, NVS, "mot", "os", "reboot", "stow"}),
    submenu_marks={
        MOTOR: frozenset({"a", "g"}),
        SEARCH: frozenset({"s"}),
        NVS: frozenset({"d", "e", "s"}),
    },
    proofs={MOTOR: ("a", re.compile(r"\bAZ\s*=\s"))},
    stranger_marks=frozenset({"mot"}),
    stranger=(
        "This dish answers like a Carryout G2 or an older Trav'ler (prompt `{prompt}`, menu `mot`), not like HAL 2.05. "
        "Give --firmware g2 if it is a Carryout G2. Nothing was moved."
    ),
    # No source has the texts of this firmware, but for its stalls (`docs/reference/travler.md`, *Faults*). Words, then.
    refusals=(
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
    ),
)
