"""What a map is doing, and what was heard where its cursor stands, in words. Pure functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import datetime, timedelta

from birdcage.base.geometry import separation
from birdcage.skymap.plan import MapFrame
from birdcage.station.state import Activity
from birdcage.station.task_state import TaskPhase, TaskState

from birdcage_tui.shown.map_book import MapShown, map_task
from birdcage_tui.shown.view import View

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
    if view.state.held is not None:
        words = f"HELD at {count}. Enter releases the dish, then u resumes the map"
        return "warn-strong", (words, f"HELD at {count}: Enter, then u", "HELD")
    why = "" if view.map_ended is None else view.map_ended.rstrip(".")
    told = f"interrupted at {count}: {why}. u resumes it" if why else f"interrupted at {count}. u resumes it"
    return "warn", (told, f"interrupted at {count}. u resumes it", f"{count}, u resumes", count)


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
            ends = f"ends {clock_words(view.utc + timedelta(seconds=left_s), view.utc)}"
            left = f"{span_words(left_s)} left"
            brief = f"{count}, {left}"
            told = f"running, {brief}, {ends}"
            return "accent-strong", (f"{told}. e pauses it", told, f"{brief}, {ends}", brief, count)
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
            if view.state.held is not None:
                words = f"HELD at {count}: {why}" if why else f"HELD at {count}. Enter releases the dish"
                return "warn-strong", (words, f"HELD at {count}", "HELD")
            return "warn", (f"interrupted at {count}: {why}", f"interrupted at {count}", "interrupted")
        case TaskPhase.OVER:
            return "text", (f"{count}. {why}", count)


def left_of(task: TaskState) -> float | None:
    """Return how many seconds a running map still takes, as the station tells; None if it does not."""
    left_s = task.found.get("left_s")
    return float(left_s) if isinstance(left_s, int | float) else None


def drift_words(task: TaskState | None) -> tuple[str, str]:
    """Return an ink, and how gain and pointing have drifted by the reference crosses; empty where none were made."""
    if task is None or "gain" not in task.found:
        return "dim", ""
    right, up = (task.found.get(name, 0.0) for name in ("right_deg", "up_deg"))
    words = f"drift: gain {task.found['gain']:.3g}, {right:+.2f}° right, {up:+.2f}° up"
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
