"""A plan as a person reads it: lines for a terminal of 80 columns."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import numpy as np

from birdcage.sky.age_words import plus_minus
from birdcage.sky.downlinks_words import air_words, satdump_words, signal_words
from birdcage.tracking.curve import Floats
from birdcage.tracking.day import Day
from birdcage.tracking.plan import Plan, PlanPart
from birdcage.tracking.plan_values import follows, is_hidden
from birdcage.tracking.pointing_error import PointingError, element_words, error_words

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink

WIDTH = 80
_ROWS = 14
"""About how many rows the table has: what happens, and times between."""
_BAR = 69
_INDENT = " " * 9
_DRIFTS_DEG = 0.005
"""What drifts less in a day stands still."""
_EVENTS = ("aos", "tca", "los")
_REFRACTION = {
    "radio": "el includes refraction, as radio waves are bent",
    "optical": "el includes refraction, as light is bent",
    "none": "el is without refraction",
}
"""By `Aim.refraction`."""
_HEAD = "UTC        event         az     el    dish az dish el   error    loss"


def plan_lines(plan: Plan) -> list[str]:
    """Return a plan in at most 80 columns: what, when, where the dish waits, how well it will point, and what not."""
    lines = [*_head(plan), "", *_summary(plan), ""]
    always = plan.day is not None and (plan.day.always_in_reach or plan.day.never_in_reach)
    if plan.legs and not always:
        lines += [*_bar(plan), ""]
    at_s = plan.legs[0].start_s if plan.legs else plan.sky.start_s
    lines += [_HEAD, *([_row(plan, at_s, "")] if always else _table(plan)), _REFRACTION[plan.aim.refraction]]
    if plan.notes:
        lines.append("")
    for note in plan.notes:
        lines += textwrap.wrap(note, WIDTH, initial_indent="· ", subsequent_indent="  ")
    return lines


def _head(plan: Plan) -> Iterator[str]:
    aim, passing = plan.aim, plan.passing
    name = aim.name if aim.norad_id is None else f"{aim.name} ({aim.norad_id})"
    day = f"{datetime.fromtimestamp(plan.sky.start_s, UTC):%a %d %b %Y} UTC"
    yield f"{name[: WIDTH - len(day) - 2]:<{WIDTH - len(day)}}{day}"
    if passing is not None:
        yield (
            f"AOS {_clock(passing.aos.timestamp())} {passing.aos_azimuth_deg:.0f}°   "
            f"TCA {_clock(passing.tca.timestamp())} {passing.max_elevation_deg:.1f}° high   "
            f"LOS {_clock(passing.los.timestamp())} {passing.los_azimuth_deg:.0f}°"
        )
    if aim.frequency_hz is not None or aim.time_offset_s:
        mhz = "" if aim.frequency_hz is None else f"{aim.frequency_hz / 1e6:.4f}".rstrip("0").rstrip(".") + " MHz"
        late = f"{aim.time_offset_s:+.1f} s along its track" if aim.time_offset_s else ""
        yield "   ".join(part for part in (mhz, late) if part)
    if aim.skew is not None:
        geometry, tilt = aim.skew.words()
        yield f"Skew {geometry}"
        yield f"Tilt {tilt}"
    if aim.downlink is not None:
        yield from textwrap.wrap(_signal(aim.downlink, plan.made_at), WIDTH)


def _signal(downlink: Downlink, now: datetime) -> str:
    """Return what is sent there: `AHRPT, RHCP, 2.333 Mbaud   SatDump metop_ahrpt   on 2026-10-16`."""
    pipeline = satdump_words(downlink)
    parts = (signal_words(downlink), f"SatDump {pipeline}" if pipeline else "", air_words(downlink, now))
    return "   ".join(part for part in parts if part)


def _summary(plan: Plan) -> Iterator[str]:
    follow_s = sum(leg.end_s - leg.start_s for leg in plan.legs if leg.part is PlanPart.FOLLOW)
    if not plan.legs or plan.course is None:
        yield "Follow   nothing: it is not within reach"
        return
    if plan.day is not None:
        yield from _stands(plan.day, plan.sky.start_s)
    whole_s = plan.sky.end_s - plan.sky.start_s
    best = plan.reach.best_el_deg
    high = "" if best is None else f", up to {best:.0f}°"
    if plan.goes_on:
        end = "you end it" if plan.reach_end_s is None else _clock(plan.reach_end_s)
        yield f"Follow   {_clock(plan.legs[0].start_s)} until {end}"
    else:
        yield (
            f"Follow   {_clock(plan.legs[0].start_s)} to {_clock(plan.legs[-1].end_s)}: "
            f"{_length(follow_s)} of {_length(whole_s)}{high}"
        )
    place = plan.preposition
    if place is not None:
        stops = f" by {len(place.waypoints)} stops" if len(place.waypoints) > 1 else ""
        yield (
            f"Leave    {_clock(place.leave_s)} for {place.true_az_deg:.1f}° / {place.true_el_deg:.1f}° "
            f"(dish {place.az_deg:+.1f}°), {place.slew_s:.1f} s{stops}"
        )
    for rewind in plan.rewinds:
        yield (
            f"Rewind   {_clock(rewind.start_s)}: dish {rewind.from_az_deg:+.0f}° to {rewind.to_az_deg:+.0f}°, "
            f"{rewind.end_s - rewind.start_s:.1f} s"
        )
    for hole in plan.keyholes:
        lost = "" if hole.max_loss_db is None else f", {_db(hole.max_loss_db)}"
        yield (
            f"Keyhole  {_clock(hole.start_s)} to {_clock(hole.end_s)}: up to {hole.max_error_deg:.2f}° off{lost} "
            f"(at best {hole.limit_deg:.2f}°)"
        )
    if plan.pointing is not None:
        yield from _error(plan.pointing)


def _stands(day: Day, now_s: float) -> Iterator[str]:
    """Yield whether it is always up, else when it rises or sets; and how far it wanders, if it does not stand still."""
    words = day.standing or ("always up" if day.always_up else "")
    if not words and (event := day.horizon_s(now_s)) is not None:
        words = f"{event[0]} {_clock(event[1])}"
    if words:
        yield f"Sky      {words}"
    if day.always_up and max(day.az_drift_deg, day.el_drift_deg) >= _DRIFTS_DEG:
        yield f"Drift    {day.az_drift_deg:.2f}° of azimuth, {day.el_drift_deg:.2f}° of elevation a day"


def _error(found: PointingError) -> Iterator[str]:
    """Yield the error that may be believed, what it costs, and of what it is made."""
    dish, median, p90 = found.dish, found.median, found.p90
    own = f"{dish.rms_deg:.3f}° RMS, {dish.max_deg:.2f}° max"
    if found.elements is None:
        loss = dish.loss_db
        decibels = "" if loss is None else f"; {_db(float(loss.mean()))} on average, {_db(float(loss.max()))} max"
        yield f"Error    {own}{decibels}"
        return
    if median is None or p90 is None:
        yield "Error    unknown"
    else:
        yield f"Error    {error_words(found)}, max {plus_minus(median.max_deg, p90.max_deg)}"
        if median.loss_db is not None and p90.loss_db is not None:
            yield f"Loss     {_loss(median.loss_db, p90.loss_db)}"
    advice = f": {found.advice}" if found.advice else ""
    yield from textwrap.wrap(
        f"{element_words(found.elements)}{advice}", WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT
    )  # fmt: skip
    yield f"{_INDENT}dish alone {own}"


def _loss(loss: Floats, of_ten: Floats) -> str:
    """Return the mean and the greatest loss, each with what one pass in ten exceeds."""
    mean, most = (f"{_db(float(f(loss)))} (90 %: {_db(float(f(of_ten)))})" for f in (np.mean, np.max))
    return f"{mean} on average, {most} max"


def _bar(plan: Plan) -> Iterator[str]:
    """Yield the pass from its beginning to its end: what is done when."""
    start, end = plan.sky.start_s, plan.sky.end_s
    times = np.linspace(start, end, 2 * _BAR + 1)[1::2]
    yield "Time     " + "".join(_glyph(plan, at) for at in times.tolist())
    used = {"━": "follow", "╍": "keyhole", "↺": "rewind", "╌": "behind the horizon mask", "·": "out of reach"}
    marks = {_glyph(plan, at) for at in times.tolist()}
    yield "         " + "   ".join(f"{glyph} {word}" for glyph, word in used.items() if glyph in marks)


def _glyph(plan: Plan, at_s: float) -> str:
    if any(leg.start_s <= at_s <= leg.end_s for leg in plan.rewinds):
        return "↺"
    if not follows(plan, at_s):
        return "·"
    if any(hole.start_s <= at_s <= hole.end_s for hole in plan.keyholes):
        return "╍"
    return "╌" if is_hidden(plan, at_s) else "━"


def _table(plan: Plan) -> Iterator[str]:
    sky = plan.sky
    told = {one.at_s: one.what.upper() if one.what in _EVENTS else one.what for one in plan.incidents}
    spacing = (sky.end_s - sky.start_s) / _ROWS
    between = [
        at
        for at in np.linspace(sky.start_s, sky.end_s, _ROWS + 1).tolist()
        if min((abs(at - other) for other in told), default=spacing) >= spacing / 2.0
    ]
    for at in sorted([*told, *between]):
        yield _row(plan, at, told.get(at, "")).rstrip()


def _row(plan: Plan, at_s: float, what: str) -> str:
    az, el = plan.sky.at(at_s)
    row = f"{_clock(at_s)}  {what:<10}{az % 360.0:6.1f} {el:6.1f}"
    course, found = plan.course, plan.pointing
    if course is None or found is None or not course.start_s <= at_s <= course.end_s:
        return row
    dish_az, dish_el = course.at(at_s)
    row += f"   {dish_az:+8.1f} {dish_el:7.1f}"
    if not follows(plan, at_s):
        return row
    if found.median is None:
        return row + f"  {'—':>6}  {'—':>6}"
    t_s, loss = found.dish.t_s, found.median.loss_db
    row += f"  {float(np.interp(at_s, t_s, found.median.error_deg)):5.2f}°"
    return row + (f"  {'—':>6}" if loss is None else f"  {_db(float(np.interp(at_s, t_s, loss))):>6}")


def _clock(at_s: float) -> str:
    return f"{datetime.fromtimestamp(at_s, UTC):%H:%M:%S}Z"


def _db(loss: float) -> str:
    return f"{loss:.2f} dB" if loss < 1.0 else f"{loss:.1f} dB"


def _length(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02} s" if minutes else f"{rest} s"
