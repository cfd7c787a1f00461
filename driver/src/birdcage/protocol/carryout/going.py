"""How a Carryout of 2003 is sent somewhere, and what its answer tells."""

from __future__ import annotations

import re
from collections.abc import Iterable
from enum import Enum

from birdcage.base.reason import Reason
from birdcage.protocol.carryout.dialect import DIALECT
from birdcage.protocol.carryout.records import LiveRecord, RecordReader

AZ_SPAN_DEG = 0.0, 360.0
"""Both public programs stay within this; how far the cable turns is not known."""
EL_SPAN_DEG = 22.0, 73.0
"""What the firmware takes as it comes from the factory. Row `EL_MAX_ROW` of its settings raises the upper end."""
EL_MAX_ROW = 102
HIGHEST_EL_DEG = 90.0
"""What the owner who published it set that row to."""
_ROW = r"^\D*\b{}\b[^\w\s]*"
_NUMBER = re.compile(r"(?:^|(?<=[\s=:]))(\d+(?:\.\d+)?)(?=\s|$)")


class GotoAnswer(Enum):
    """What the reply to a go-to tells."""

    MOVING = "moving"
    """Records came: the motors ran."""
    REFUSED = "refused"
    """It holds a word of refusal."""
    NOTHING = "nothing"
    """Neither: it was there already, refused in other words, took it without a record, or tells nothing yet."""


def go_line(az_deg: float, el_deg: float) -> str:
    """Return the line of menu `target` that sends both axes to absolute angles; an axis cannot be left out.

    ValueError outside 0..360 and 22..90: no source tells what the dish would do. The gate knows the lower ceiling.
    """
    low, high = AZ_SPAN_DEG
    if not low <= az_deg <= high or not EL_SPAN_DEG[0] <= el_deg <= HIGHEST_EL_DEG:
        raise ValueError(f"azimuth {az_deg}, elevation {el_deg}: 0 to 360, 22 to 90")
    return f"g {az_deg:.2f} {el_deg:.2f}"


def judge_go(lines: Iterable[str]) -> tuple[GotoAnswer, LiveRecord | None]:
    """Return what the lines of a reply to `go_line` tell, and the last record among them.

    A refusal among records counts as a refusal: it may be that of a second go-to.
    """
    reader, last, refused = RecordReader(), None, False
    for line in lines:
        refused = refused or refusal_of(line) is not None
        for record in reader.feed_line(line):
            last = record
    if refused:
        return GotoAnswer.REFUSED, last
    return (GotoAnswer.NOTHING if last is None else GotoAnswer.MOVING), last


def refusal_of(line: str) -> Reason | None:
    """Return the reason of `CommandRefused` that a line stands for; None for any other line."""
    return next((reason for pattern, reason in DIALECT.refusals if pattern.search(line)), None)


def ceiling_of(lines: Iterable[str]) -> float | None:
    """Return the greatest elevation that `e 102` of menu `nvs` shows, in degrees; None when none is to be seen.

    How a row is printed is not known: taken is the first number that stands by itself behind the row's own, above
    the floor and up to 90. Records of a move under way may come in between.
    """
    text = ceiling_text(lines)
    return None if text is None else float(text)


def ceiling_text(lines: Iterable[str]) -> str | None:
    """Return the same as printed."""
    for line in lines:
        found = _NUMBER.search(re.sub(_ROW.format(EL_MAX_ROW), " ", line))
        if found and refusal_of(line) is None and EL_SPAN_DEG[0] < float(found[1]) <= HIGHEST_EL_DEG:
            return found[1]
    return None
