"""How such a console looks: its prompts are known, and what it says to a line that it refuses is not."""

from __future__ import annotations

import re

from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.family import AXIS_NAMES, MOTOR_TROUBLES

REFUSALS = (
    (re.compile(r"\b(invalid|unknown|unrecognized) command\b", re.IGNORECASE), Reason.UNKNOWN_COMMAND),
    (
        re.compile(r"\b(invalid|bad|illegal)\b.*\b(parameter|argument|value|motor|angle)\b", re.IGNORECASE),
        Reason.BAD_PARAMETER,
    ),
    (re.compile(r"\b(out of range|outside|limit exceeded)\b", re.IGNORECASE), Reason.BAD_PARAMETER),
    (
        re.compile(r"^\s*(error|failed)\b(?! to read eeprom index)|\bSTALLED\b|\bHome Failure\b", re.IGNORECASE),
        Reason.FAILED,
    ),
)
"""Words, not sentences: the texts themselves are in no source (docs/reference/g2.md, *Hazards*)."""


def kin_dialect(name: str, *menus: str, line_end: bytes = b"\r") -> ConsoleDialect:
    """Return the dialect of a relative of the G2 with these menus, each below a prompt of its own name.

    Only `MOT>` was read of any of them; the root's `TRK>` is the G2's (docs/reference/g2-kin.md, *Menus*). So is
    `Step to Position EL angle error: 2147483647` of an axis that is not homed: one that does not tell where it is would
    not show otherwise that nothing moves.
    """
    return ConsoleDialect(
        troubles=MOTOR_TROUBLES,
        axis_names=AXIS_NAMES,
        prompts={"root": "TRK>", **{menu: f"{menu.upper()}>" for menu in menus}},
        submenu_marks={"mot": frozenset({"a", "h"})},
        line_end=line_end,
        stranger=(
            f"This dish does not answer like a {name} (prompt `{{prompt}}`): it has no menu `mot`. Nothing was moved."
        ),
        refusals=(*REFUSALS, (re.compile(r"\bStep to Position\b.*\berror\b", re.IGNORECASE), Reason.FAILED)),
    )
