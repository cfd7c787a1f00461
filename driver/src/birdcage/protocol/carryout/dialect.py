"""How the console of a Carryout of 2003 looks, as far as it is known: its prompts are learnt."""

from __future__ import annotations

import re

from birdcage.base.reason import Reason
from birdcage.console.dialect import UNKNOWN_TOKEN, ConsoleDialect
from birdcage.protocol.carryout.records import LIVE

BAUD = 57600
TARGET, MOTOR, DVB, OS, NVS = "target", "motor", "dvb", "os", "nvs"

DIALECT = ConsoleDialect(
    prompts=dict.fromkeys(("root", TARGET, MOTOR, DVB, OS, NVS), UNKNOWN_TOKEN),
    root_marks=frozenset({TARGET, MOTOR}),
    root_hints=frozenset({TARGET, MOTOR, DVB, OS, NVS}),
    submenu_marks={TARGET: frozenset({"g"}), NVS: frozenset({"e", "s"})},
    stranger_marks=frozenset({"mot", "ngsearch"}),
    stranger=(
        "This dish answers like a Carryout G2 or a Trav'ler (prompt `{prompt}`), not like a Carryout of 2003. "
        "Nothing was moved."
    ),
    live=LIVE,
    # No source has a text of this firmware. These are words that any console may use.
    refusals=(
        (re.compile(r"\b(invalid|unknown|unrecognized|bad) command\b", re.IGNORECASE), Reason.UNKNOWN_COMMAND),
        (
            re.compile(r"\b(invalid|bad|illegal)\b.*\b(parameter|argument|value|target|angle)\b", re.IGNORECASE),
            Reason.BAD_PARAMETER,
        ),
        (re.compile(r"\b(out of range|outside|limit exceeded|not allowed)\b", re.IGNORECASE), Reason.BAD_PARAMETER),
        (re.compile(r"^\s*(error|failed)\b|\bbusy\b|\bnot (calibrated|homed|ready)\b", re.IGNORECASE), Reason.FAILED),
    ),
)
