"""Features and readings as plain values: what `birdcage features`, `get`, `set` and the control channel tell."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import asdict
from typing import Any

from birdcage.base import errors
from birdcage.base.errors import BirdcageError, CommandRefused, MotionRefused
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.base.trouble import MotorTrouble
from birdcage.rotator.feature import Feature, FeatureKind, Range, Reading

Values = dict[str, object]


def feature_values(feature: Feature) -> Values:
    """Return one row of the table as a dict that JSON can hold; what does not apply is None."""
    limits, cost = feature.range or Range(), feature.cost
    return {
        "id": feature.id, "label": feature.label, "unit": feature.unit or None, "kind": feature.kind.value,
        "low": limits.low if math.isfinite(limits.low) else None,
        "high": limits.high if math.isfinite(limits.high) else None,
        "writer": feature.writer.value, "told": feature.is_readable, "hazard": feature.hazard or None,
        "note": feature.note or None, "read_hazard": feature.read_hazard or None,
        "cost": {
            "lines": cost.lines, "menu": cost.menu, "min_interval_s": cost.min_interval_s,
            "while_moving": cost.while_moving,
        },
        "page": feature.page.value if feature.page else None, "group": feature.group or None,
        "asked": feature.asked or None,
    }  # fmt: skip


def told_in_lines(rows: Iterable[Mapping[str, Any]]) -> frozenset[str]:
    """Return the ids of those rows (`feature_values`) whose text has several lines."""
    return frozenset(row["id"] for row in rows if row["kind"] == FeatureKind.LINES.value)


def reading_values(
    ids: Iterable[str], in_lines: Collection[str], readings: Mapping[str, Reading]
) -> dict[str, Values | None]:
    """Return what was read, by id; None for what the dish did not tell. Text of what is told `in_lines` is a list."""
    return {each: _told(readings.get(each), in_lines=each in in_lines) for each in ids}


def _told(reading: Reading | None, *, in_lines: bool) -> Values | None:
    if reading is None:
        return None
    value = str(reading.value).splitlines() if in_lines else reading.value
    return {"value": value, "unit": reading.unit or None, "utc": reading.utc.isoformat(timespec="milliseconds")}


def may_be_set(feature: str) -> str:
    """Return what is said of a feature that may have been set after its command had ended."""
    return f"Whether {feature} was set is not known."


def only_held(feature: str, label: str) -> str:
    """Return why a feature that is `HELD` is not set, and what runs it."""
    return (
        f"{label}: it runs only while it is held. F4, Motors does that, and `birdcage motors run {feature} VALUE` for "
        "a moment. Nothing was sent."
    )


def error_values(error: BirdcageError) -> Values:
    """Return an error, for another process to raise, with the numbers and values that it carries."""
    told: dict[str, object] = {"kind": type(error).__name__, "reason": error.reason, "sentence": str(error)}
    if isinstance(error, MotionRefused):
        told |= {"limit_deg": error.limit_deg, "by_deg": error.by_deg}
    if isinstance(error, CommandRefused) and error.trouble is not None:
        told["trouble"] = asdict(error.trouble)
    return told


def error_of(told: Mapping[str, object]) -> BirdcageError:
    """Return the error that `error_values` has told of."""
    kind = getattr(errors, str(told.get("kind")), BirdcageError)
    if not (isinstance(kind, type) and issubclass(kind, BirdcageError)):
        kind = BirdcageError
    error = kind(str(told.get("sentence")), reason=_reason_of(told.get("reason")))
    if isinstance(error, MotionRefused):
        error.limit_deg, error.by_deg = (_number_of(told.get(name)) for name in ("limit_deg", "by_deg"))
    if isinstance(error, CommandRefused):
        error.trouble = _trouble_of(told.get("trouble"))
    return error


def _number_of(told: object) -> float | None:
    return float(told) if isinstance(told, int | float) and not isinstance(told, bool) else None


def _trouble_of(told: object) -> MotorTrouble | None:
    """Return the trouble of a motor; None for what is none, or has another form in a newer program."""
    match told:
        case {"axis": str(axis), "homing": bool(homing), "said": str(said)}:
            return MotorTrouble(clean(axis), homing, clean(said))
    return None


def _reason_of(word: object) -> Reason | None:
    """Return the reason of that value; None, the kind's own, for one that a newer program told."""
    return next((reason for reason in Reason if reason.value == word), None)
