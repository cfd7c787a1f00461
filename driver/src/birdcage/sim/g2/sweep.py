"""The sweeps that the firmware makes by itself: `azscan` and `azscanwxp` of `MOT>`, `scan` of `ADC>`.

The arguments of the first two and the line of `scan` are quoted (noted: docs/reference/g2-motors.md, *Sweeps*); that
the other two print the same line, their rate and their path are assumed or settings. Lock and SNR are the tuner's at
that instant.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.tuner import TRANSPONDERS
from birdcage.sim.shell import Die, Listen, Pause, Script, Step
from birdcage.sim.trk.limits import INT_MAX, angle_error, motor, number

Part = Generator[Step, bool | None, bool]
"""A part of a script that tells whether a key broke it off."""


@dataclass(frozen=True, slots=True)
class Sweep:
    """One way along an axis: `points` positions, the first where it stands."""

    motor: int
    step_cdeg: int
    """Signed: the way it goes."""
    points: int
    pause_s: float = 0.0
    """Before each reading, once the axis stands."""
    transponders: int = 0
    """How many are tried at each position, from number 1; 0 for the one that is tuned."""
    scale: str = "tuner"
    """Whose counts it prints: those of the `tuner`, or of the `adc` before it."""


def azscan(board: G2Board, args: list[str]) -> Script | None:
    """`azscan [az_rel] [el_rel] [delay]`: degrees, degrees and milliseconds (assumed); setting `azscan_rows`."""
    given = [number(text) for text in args]
    if len(given) > 3 or None in given:
        return None
    az, el, delay = [value or 0.0 for value in given] + [board.settings.scan_span, 0.0, 0.0][len(given) :]
    if delay < 0 or az == 0:
        return None
    return _guarded(board, 0, lambda: _rows(board, az, el, delay / 1000.0))


def azscanwxp(board: G2Board, args: list[str]) -> Script | None:
    """`azscanwxp [motor] [span_deg] [res_cdeg] [num_xponders]`: `0 10 100 3` is 30 lines (noted)."""
    settings = board.settings
    index = motor(args[0]) if args else 0
    given = [number(text) for text in args[1:]]
    if index is None or len(given) > 3 or None in given:
        return None
    defaults = [settings.scan_span, float(settings.scan_step_cdeg), 1.0]
    span, step, transponders = [value or 0.0 for value in given] + defaults[len(given) :]
    if span == 0 or step < 1 or int(step) != step or transponders not in range(1, TRANSPONDERS + 1):
        return None
    points = max(round(abs(span) * 100 / step), 1)
    step_cdeg = int(step) if span > 0 else -int(step)
    wanted = Sweep(index, step_cdeg, points, transponders=int(transponders), scale=settings.azscan_rssi)
    return _guarded(board, index, lambda: _row(board, wanted))


def adc_scan(board: G2Board, args: list[str]) -> Script | None:
    """`scan`: azimuth, or `scan [motor] [span_deg] [res_cdeg]`; both ends are read."""
    settings = board.settings
    index = motor(args[0]) if args else 0
    given = [number(text) for text in args[1:]]
    if index is None or len(given) > 2 or None in given:
        return None
    span, step = [value or 0.0 for value in given] + [settings.scan_span, float(settings.scan_step_cdeg)][len(given) :]
    if span == 0 or step < 1 or int(step) != step:
        return None
    step_cdeg = int(step) if span > 0 else -int(step)
    wanted = Sweep(index, step_cdeg, round(abs(span) * 100 / step) + 1, scale=settings.scan_rssi)
    if args and not board.dish.axes[index].homed:
        return _refuse(board.dish.axes[index])  # only without arguments is it said to hang
    return _guarded(board, index, lambda: _row(board, wanted))


def _guarded(board: G2Board, index: int, script: Callable[[], Generator[Step, bool | None, object]]) -> Script:
    """Sweep if the axis knows where it is; else it is sent to INT_MAX, and the shell waits for that (noted)."""
    axes = board.dish.axes
    axis = axes[index]
    if axis.homed:
        yield from script()
    elif board.settings.unhomed_scan == "error":
        yield from _refuse(axis)
    else:
        if not axes[1].homed:
            yield angle_error(axes[1])
        axis.retarget(board.now_s, INT_MAX * axis.step_deg)
        yield Die()


def _refuse(axis: AxisMechanics) -> Script:
    yield angle_error(axis)


def _rows(board: G2Board, az_deg: float, el_deg: float, pause_s: float) -> Script:
    el = board.dish.axes[1]
    step = board.settings.scan_step_cdeg if az_deg > 0 else -board.settings.scan_step_cdeg
    points = max(round(abs(az_deg) * 100 / abs(step)), 1)
    rows = board.settings.azscan_rows if el_deg and el.homed else 1
    for row in range(rows):
        if row:
            low, high = board.bounds(1)
            goal = el.ordered_deg() + el_deg
            if not low <= goal <= high:
                return
            el.retarget(board.now_s, goal)
            yield Pause(max(el.end_s() - board.now_s, 0.0))
            step = -step
        ended = yield from _row(board, Sweep(0, step, points, pause_s, scale=board.settings.azscan_rssi))
        if ended:
            return


def _row(board: G2Board, sweep: Sweep) -> Part:
    """Go along, and return whether a key broke it off (setting `sweep_key`)."""
    axis = board.dish.axes[sweep.motor]
    low, high = board.bounds(sweep.motor)
    start = axis.count(board.now_s)[0]
    way = sweep.step_cdeg / 100.0
    if not low <= start + way * (sweep.points - 1) <= high:
        way = -way
    if not low <= start + way * (sweep.points - 1) <= high:
        yield f"{board.settings.out_of_range_text}\n"
        return True
    tuned = range(1, sweep.transponders + 1) or (None,)
    for point in range(sweep.points):
        if point:
            axis.retarget(board.now_s, start + way * point)
        waits = max(axis.end_s() - board.now_s, 0.0) + sweep.pause_s
        for transponder in tuned:
            if transponder is not None:
                board.tuner.select(transponder)
                waits += board.settings.xponder_s
            ended = yield from _wait(board, waits + board.settings.scan_read_s)
            if ended:
                axis.brake(board.now_s)
                return True
            yield f"{_line(board, sweep, axis)}{_mark(board, transponder)}\n"
            waits = 0.0
        if board.settings.xponder_style == "blank" and sweep.transponders:
            yield "\n"
    return False


def _wait(board: G2Board, seconds: float) -> Part:
    if board.settings.sweep_key == "abort":
        return bool((yield Listen(seconds)))
    yield Pause(seconds)
    return False


def _line(board: G2Board, sweep: Sweep, axis: AxisMechanics) -> str:
    now_s = board.now_s
    centideg = round(axis.count(now_s)[0] * 100)
    heard = board.tuner.read(now_s)
    rssi = heard.rssi if sweep.scale == "tuner" else board.adc_counts()
    return (
        f"Motor:{sweep.motor} Angle:{centideg % 36000 if sweep.motor == 0 else centideg} RSSI:{rssi} "
        f"Lock:{int(heard.locked)} SNR:{heard.snr_db:.0f} Scan Delta:{abs(sweep.step_cdeg)}"
    )


def _mark(board: G2Board, transponder: int | None) -> str:
    return f" Xponder:{transponder}" if board.settings.xponder_style == "labelled" and transponder is not None else ""
