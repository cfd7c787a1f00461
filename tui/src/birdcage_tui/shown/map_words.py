"""What a map is doing, and what was heard where its cursor stands, in words. Pure functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from birdcage.base.geometry import separation
from birdcage.skymap.plan import MapFrame
from birdcage.station.state import Activity
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage.station.tasks.words import ended_by

from birdcage_tui.shown.map_book import MapShown, map_task
from birdcage_tui.shown.view import YOU, View

SlotPlace = tuple[str, float, float]
"""Name, azimuth and elevation of a satellite of the arc."""


def state_words(view: View) -> tuple[str, tuple[str, ...]]:
    """Return an ink, and what the map that is shown is doing: from all there is to say to the least."""
    shown = view.map
    task = map_task(view.state.tasks, "" if shown is None else shown.key)
    if task is not None:
        return _of_task(view, task, _count(task, shown))
    if shown is None:
        return "dim", ("",)
    count = f"{shown.heard} of {shown.plan.cells}"
    if shown.is_complete:
        ended = "" if shown.sky.ended is None else f" {shown.sky.ended:%Y-%m-%d %H:%M}Z"
        beyond = shown.plan.cells - shown.heard
        heard = f"{shown.heard} heard, {beyond} out of reach" if beyond else f"all {shown.heard} heard"
        return "good", (f"finished{ended}, {heard}", f"finished{ended}", "finished")
    brief = f"unfinished, {count}"
    if view.state.fault is not None:
        words = f"{brief}. Dish FAULT: Enter acknowledges it first"
        return "warn-strong", (words, f"{brief}. FAULT: Enter", brief, count)
    then = "" if _is_pocket(view) else ", then u resumes the map"
    if view.state.held is not None:
        words = f"{brief}. Dish HELD: Enter releases it"
        return "warn-strong", (f"{words}{then}", words, f"{brief}. HELD", brief, count)
    resumes = "" if _is_pocket(view) else ". u resumes it"
    if view.map_ended == ended_by(YOU):
        return "warn", (f"paused at {count}{resumes}", f"paused, {count}", count)
    # Its first sentence says why; what follows tells how many were heard, and how it is resumed, as this line does.
    why = "" if view.map_ended is None else view.map_ended.partition(". ")[0].rstrip(".")
    told = f"{brief}: {why}{resumes}" if why else f"{brief}{resumes}"
    return "warn", (told, f"{brief}{resumes}", brief, count)


def enter_first(view: View) -> str:
    """Return what Enter does before anything else, as row 1 says, too; empty where nothing is in its way."""
    state = view.state
    if state.fault is not None:
        return "acknowledges the fault"
    if state.held is not None:
        return "releases the dish"
    return "accepts the dish's own limits" if state.motion_refused_because else ""


def _is_pocket(view: View) -> bool:
    """Return whether the pocket view is seen, which has no keys of a map but the one that shows it."""
    return "pocket" in view.scopes


def _count(task: TaskState, shown: MapShown | None) -> str:
    of = task.of if task.of is not None else None if shown is None else shown.plan.cells
    done = task.done if task.done is not None else 0 if shown is None else shown.heard
    return f"{done} of {'—' if of is None else of}"


def _of_task(view: View, task: TaskState, count: str) -> tuple[str, tuple[str, ...]]:
    why = task.why.rstrip(".")
    match task.phase:
        case TaskPhase.RUNNING:
            if view.state.activity is Activity.HOMING:
                return "warn", (f"homing, {count} heard", "homing")
            left_s = left_of(task)
            if left_s is None:
                return "accent-strong", (f"running, {count}", count)
            ends = _end_words(task, view.utc, left_s)
            left = f"{span_words(left_s)} left"
            brief = f"{count}, {left}"
            told = f"running, {brief}, {ends}"
            pauses = () if _is_pocket(view) else (f"{told}. e pauses it",)
            return "accent-strong", (*pauses, told, f"{brief}, {ends}", brief, count)
        case TaskPhase.WAITING:
            until = "" if task.next_at is None else f" until {clock_words(task.next_at, view.utc)}"
            return "text", (f"waiting{until}, {count} heard", f"waiting{until}", "waiting")
        case TaskPhase.COUNTDOWN:
            left_s = 0.0 if task.next_at is None else max((task.next_at - view.utc).total_seconds(), 0.0)
            return "warn-strong", (f"MOVES in {left_s:.0f} s, Space cancels. {count} heard", f"MOVES in {left_s:.0f} s")
        case TaskPhase.YIELDED:
            told = view.state.not_now.rstrip(".") or why or f"{view.state.holder or 'somebody else'} has control"
            what = "not now" if view.state.not_now else "paused"
            return "warn", (f"{what}: {told}. {count} heard", f"{what}, {count}", what)
        case TaskPhase.INTERRUPTED:
            return _interrupted_words(view, count, why)
        case TaskPhase.OVER:
            return "text", (f"{count}. {why}", count)


def _interrupted_words(view: View, count: str, why: str) -> tuple[str, tuple[str, ...]]:
    at = f"HELD at {count}" if view.state.held is not None else f"interrupted at {count}"
    brief = (at, at.partition(" ")[0])
    if view.state.fault is not None:
        return "warn-strong", (f"{at}. Enter acknowledges the fault first", *brief)
    told = (f"{at}: {why}",) if why else ()
    if view.state.held is not None:
        return "warn-strong", (*told, f"{at}. Enter releases the dish, and the map goes on", *brief)
    return "warn", (*told, *brief)


def _end_words(task: TaskState, now: datetime, left_s: float) -> str:
    """Return when it will be whole; or until when it goes on, where that comes before."""
    ends, until_s = now + timedelta(seconds=left_s), task.found.get("until_s")
    if isinstance(until_s, int | float) and until_s < ends.timestamp():
        return f"pauses {clock_words(datetime.fromtimestamp(until_s, UTC), now)}"
    return f"ends {clock_words(ends, now)}"


def left_of(task: TaskState) -> float | None:
    """Return how many seconds a running map still takes, as the station tells; None if it does not."""
    left_s = task.found.get("left_s")
    return float(left_s) if isinstance(left_s, int | float) else None


def drift_words(task: TaskState | None, *, decibels: bool) -> tuple[str, str]:
    """Return an ink, and how gain and pointing have drifted by the reference crosses; empty where none were made."""
    if task is None or "gain" not in task.found:
        return "dim", ""
    value = float(str(task.found["gain"]))
    gain = f"{value:+.2f} dB" if decibels else f"×{value:.3g}"
    right, up = (task.found.get(name, 0.0) for name in ("right_deg", "up_deg"))
    words = f"drift: gain {gain}, {right:+.2f}° right, {up:+.2f}° up"
    return ("fault-strong", f"LOST STEPS, {words}") if task.found.get("lost_steps") else ("dim", words)


def span_words(seconds: float) -> str:
    """Return how long something takes: `40 s`, `12 min`, `1 h 12 min`."""
    if seconds < 90.0:
        return f"{max(seconds, 0.0):.0f} s"
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"


def clock_words(when: datetime, now: datetime) -> str:
    """Return a time of day in UTC; with its date where that is a day or more away."""
    near = abs((when - now).total_seconds()) < 86_400.0
    return f"{when:%H:%M}Z" if near else f"{when:%Y-%m-%d %H:%M}Z"


def value_words(shown: MapShown, value: float) -> str:
    """Return a value with as many digits as its scale needs, without the unit."""
    span = 1.0 if shown.span is None else shown.span[1] - shown.span[0]
    if not shown.sky.decibels:
        return f"{value:.{0 if span >= 10.0 else 1}f}"
    digits = 1 if span >= 2.0 else 2 if span >= 0.2 else 3
    return f"{value:.{digits}f}"


def readout(shown: MapShown, cell: int, slots: Sequence[SlotPlace], *, brief: bool = False) -> list[str]:
    """Return what is known of a cell, what counts most first; `brief`: in some 40 columns."""
    x_deg, y_deg = shown.plan.at(cell)
    sample, value = shown.samples.get(cell), shown.value(cell)
    if shown.plan.frame is MapFrame.TARGET:
        where = f"{x_deg:+.2f}° right, {y_deg:+.2f}° up"
    else:
        where = f"{x_deg % 360.0:.1f}°/{y_deg:.1f}°" if brief else f"az {x_deg % 360.0:.2f}° el {y_deg:.2f}°"
    if value is None:
        return [where, "not heard", *_nearest(shown, x_deg, y_deg, slots)]
    told = [where, f"{value_words(shown, value)} {shown.sky.unit}"]
    if sample is None:
        return [*told, *_nearest(shown, x_deg, y_deg, slots)]
    if sample.scatter is not None:
        told[1] = f"{value_words(shown, value)} ±{sample.scatter:.2g} {shown.sky.unit}"
    told.append(f"n {sample.n}")
    told += _nearest(shown, x_deg, y_deg, slots)
    if sample.utc is not None:
        told.append(f"{sample.utc:%H:%M:%S}Z")
    if sample.snr_db is not None:
        told.append(f"SNR {sample.snr_db:.1f} dB")
    if sample.lock is not None:
        told.append("lock" if sample.lock else "no lock")
    if shown.plan.frame is MapFrame.TARGET:
        told.append(f"az {sample.az_deg:.2f}° el {sample.el_deg:.2f}°")
    return told


def _nearest(shown: MapShown, az_deg: float, el_deg: float, slots: Sequence[SlotPlace]) -> list[str]:
    """Return the nearest satellite of the arc and how far it is, where one is near enough to be meant."""
    if shown.plan.frame is MapFrame.TARGET or not slots:
        return []
    far, name = min((separation(az_deg, el_deg, az, el), name) for name, az, el in slots)
    return [f"{name} {far:.1f}° away"] if math.isfinite(far) and far <= 30.0 else []
