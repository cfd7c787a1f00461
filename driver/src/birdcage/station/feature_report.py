"""Features and readings as plain values: what `birdcage features`, `get`, `set` and the control channel tell."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from birdcage.base import errors
from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
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
        "cost": {
            "lines": cost.lines, "menu": cost.menu, "min_interval_s": cost.min_interval_s,
            "while_moving": cost.while_moving,
        },
    }  # fmt: skip


def reading_values(
    ids: Iterable[str], features: Mapping[str, Feature], readings: Mapping[str, Reading]
) -> dict[str, Values | None]:
    """Return what was read, by id; None for what the dish did not tell. Text of several lines is a list of them."""
    return {each: _told(features.get(each), readings.get(each)) for each in ids}


def _told(feature: Feature | None, reading: Reading | None) -> Values | None:
    if reading is None:
        return None
    lines = feature is not None and feature.kind is FeatureKind.LINES
    value = str(reading.value).splitlines() if lines else reading.value
    return {"value": value, "unit": reading.unit or None, "utc": reading.utc.isoformat(timespec="milliseconds")}


def may_be_set(feature: str) -> str:
    """Return what is said of a feature that may have been set after its command had ended."""
    return f"Whether {feature} was set is not known."


def error_values(error: BirdcageError) -> Values:
    """Return an error, for another process to raise."""
    return {"kind": type(error).__name__, "reason": error.reason, "sentence": str(error)}


def error_of(told: Mapping[str, object]) -> BirdcageError:
    """Return the error that `error_values` has told of."""
    kind = getattr(errors, str(told.get("kind")), BirdcageError)
    if not (isinstance(kind, type) and issubclass(kind, BirdcageError)):
        kind = BirdcageError
    return kind(str(told.get("sentence")), reason=_reason_of(told.get("reason")))


def _reason_of(word: object) -> Reason | None:
    """Return the reason of that value; None, the kind's own, for one that a newer program told."""
    return next((reason for reason in Reason if reason.value == word), None)
