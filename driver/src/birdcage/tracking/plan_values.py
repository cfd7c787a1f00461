"""A plan as plain values, for `--json`: every time is ISO 8601 in UTC with Z, and names carry their units."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

import numpy as np

from birdcage.sky.age import error_values
from birdcage.sky.downlinks_words import downlink_values
from birdcage.sky.element_error import ElementError
from birdcage.sky.export.fields import iso
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import LossReason, PassReach
from birdcage.tracking.day import HOURS, Day
from birdcage.tracking.plan import Forecast, Plan, PlanLeg, Preposition
from birdcage.tracking.pointing_error import Level, PointingError

_STEP_S = 1.0
_MOST = 1200


def plan_values(plan: Plan, *, step_s: float = _STEP_S) -> dict[str, Any]:
    """Return a plan for a program to read; `step_s`: how far apart the points of its path are. Unknown is None."""
    aim = plan.aim
    return {
        "target": {
            "name": aim.name, "kind": aim.kind, "norad_id": aim.norad_id, "frequency_hz": aim.frequency_hz,
            "time_offset_s": aim.time_offset_s,
            "downlink": None if aim.downlink is None else downlink_values(aim.downlink, plan.made_at),
        },
        "refraction": aim.refraction,
        **({} if aim.skew is None else aim.skew.values()),
        "made_at": iso(plan.made_at),
        "pass": None if plan.passing is None else _pass(plan.passing),
        "always_up": None if plan.passing is None and plan.day is None else bool(plan.day and plan.day.always_up),
        "day": None if plan.day is None else _day(plan.day),
        "reach": _reach(plan.reach, goes_on=plan.goes_on),
        "legs": [_leg(leg) for leg in plan.legs],
        "rewinds": len(plan.rewinds),
        "preposition": None if plan.preposition is None else _place(plan.preposition),
        "keyholes": [
            {
                "start": _at(hole.start_s), "end": _at(hole.end_s), "max_error_deg": _round(hole.max_error_deg),
                "limit_deg": _round(hole.limit_deg), "max_loss_db": _round(hole.max_loss_db),
            }
            for hole in plan.keyholes
        ],
        "elements": None if plan.elements is None else _elements(plan.elements),
        "forecast": None if plan.pointing is None else _forecast(plan.pointing),
        "dish_forecast": None if plan.forecast is None else _dish(plan.forecast),
        "share": plan.share,
        "refined": plan.refined,
        "incidents": [{"at": _at(one.at_s), "what": one.what, "text": one.text} for one in plan.incidents],
        "notes": list(plan.notes),
        "path": _path(plan, step_s),
    }  # fmt: skip


def _at(t_s: float) -> str:
    return iso(datetime.fromtimestamp(t_s, UTC))


def _pass(passing: Pass) -> dict[str, Any]:
    return {
        "aos": iso(passing.aos), "tca": iso(passing.tca), "los": iso(passing.los),
        "aos_azimuth_deg": _round(passing.aos_azimuth_deg), "tca_azimuth_deg": _round(passing.tca_azimuth_deg),
        "los_azimuth_deg": _round(passing.los_azimuth_deg), "max_elevation_deg": _round(passing.max_elevation_deg),
    }  # fmt: skip


def _day(day: Day) -> dict[str, Any]:
    return {
        "hours": HOURS, "az_drift_deg": _round(day.az_drift_deg), "el_drift_deg": _round(day.el_drift_deg),
        "always_in_reach": day.always_in_reach, "reach": _reach(day.reach, goes_on=False),
    }  # fmt: skip


def _reach(reach: PassReach, *, goes_on: bool) -> dict[str, Any]:
    """Return it; where it `goes_on` beyond the plan, without the end of the last interval and without a total."""
    last = reach.intervals[-1] if goes_on and reach.intervals else None
    return {
        "total_s": None if goes_on else _round(reach.total_s),
        "best_el_deg": _round(reach.best_el_deg),
        "intervals": [
            {"start": iso(one.start), "end": None if one is last else iso(one.end), "turn": one.turn}
            for one in reach.intervals
        ],
        "lost": [{"start": iso(one.start), "end": iso(one.end), "reason": one.cause.words} for one in reach.lost],
    }


def _leg(leg: PlanLeg) -> dict[str, Any]:
    return {
        "part": leg.part.value, "start": _at(leg.start_s), "end": _at(leg.end_s),
        "from_dish_az_deg": _round(leg.from_az_deg), "to_dish_az_deg": _round(leg.to_az_deg), "turn": leg.turn,
        "waypoints_dish_az_el_deg": _points(leg.waypoints),
    }  # fmt: skip


def _place(place: Preposition) -> dict[str, Any]:
    return {
        "dish_az_deg": _round(place.az_deg), "dish_el_deg": _round(place.el_deg),
        "true_az_deg": _round(place.true_az_deg), "true_el_deg": _round(place.true_el_deg),
        "waypoints_dish_az_el_deg": _points(place.waypoints), "leave": _at(place.leave_s),
        "slew_s": _round(place.slew_s),
    }  # fmt: skip


def _elements(found: ElementError) -> dict[str, Any]:
    closest = found.closest
    return {"epoch": iso(found.elements.epoch), "age_s": round(closest.age_s), **error_values(closest)}


def _forecast(found: PointingError) -> dict[str, Any]:
    """Return the error that may be believed, dish and elements together: as a rule, and in nine cases of ten."""
    return {
        **_level(found.median, ""),
        **_level(found.p90, "_p90"),
        "unknown_because": found.unknown or None,
        "advice": found.advice or None,
    }


def _level(level: Level | None, suffix: str) -> dict[str, Any]:
    loss = None if level is None else level.loss_db
    return {
        f"rms_error{suffix}_deg": None if level is None else _round(level.rms_deg),
        f"max_error{suffix}_deg": None if level is None else _round(level.max_deg),
        f"mean_loss{suffix}_db": None if loss is None else _round(float(loss.mean())),
        f"max_loss{suffix}_db": None if loss is None else _round(float(loss.max())),
    }


def _dish(forecast: Forecast) -> dict[str, Any]:
    return {"rms_error_deg": _round(forecast.rms_deg), "max_error_deg": _round(forecast.max_deg)}


def _path(plan: Plan, step_s: float) -> list[dict[str, Any]]:
    """Return where the target stands, and the dish wherever it follows or is on its way between two legs."""
    sky, course, found = plan.sky, plan.course, plan.pointing
    step_s = max(step_s, (sky.end_s - sky.start_s) / _MOST)
    times = np.arange(sky.start_s, sky.end_s, step_s)
    az, el = sky.sample(times)
    rows = []
    for at, true_az, true_el in zip(times.tolist(), az.tolist(), el.tolist(), strict=True):
        row: dict[str, Any] = {"at": _at(at), "true_az_deg": _round(true_az % 360.0), "true_el_deg": _round(true_el),
            "dish_az_deg": None, "dish_el_deg": None, "expected_error_deg": None, "dish_error_deg": None,
            "loss_db": None}  # fmt: skip
        if course is not None and course.start_s <= at <= course.end_s:
            row["dish_az_deg"], row["dish_el_deg"] = (_round(angle) for angle in course.at(at))
        if found is not None and follows(plan, at):
            t_s, level = found.dish.t_s, found.median
            row["dish_error_deg"] = _round(float(np.interp(at, t_s, found.dish.error_deg)))
            if level is not None:
                row["expected_error_deg"] = _round(float(np.interp(at, t_s, level.error_deg)))
            if level is not None and level.loss_db is not None:
                row["loss_db"] = _round(float(np.interp(at, t_s, level.loss_db)))
        rows.append(row)
    return rows


def follows(plan: Plan, at_s: float) -> bool:
    """Return whether the dish is to be on the target at a time."""
    return any(leg.part.value == "follow" and leg.start_s <= at_s <= leg.end_s for leg in plan.legs)


def is_hidden(plan: Plan, at_s: float) -> bool:
    """Return whether the target is behind the horizon mask at a time."""
    return any(
        one.reason is LossReason.HORIZON and one.start.timestamp() <= at_s <= one.end.timestamp()
        for one in plan.reach.lost
    )


def _points(points: Sequence[tuple[float, float]]) -> list[list[float | None]]:
    return [[_round(az), _round(el)] for az, el in points]


def _round(value: float | None) -> float | None:
    """Return an angle to a tenth of a motor's step; not -0."""
    return None if value is None else round(value, 4) + 0.0
