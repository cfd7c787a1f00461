"""What the next reading of a motion under way must be, as far as that is known."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.motion import STOP_LATENCY_S, AxisMotion, DishMotion
from birdcage.antenna.reading_filter import JITTER_S, NEAR_DEG, AngleSpan, Expected
from birdcage.base.geometry import shortest_turn
from birdcage.kinematics import Slew
from birdcage.rotator.values import Position

_HALVINGS = 24
_STREAM_EARLY_S = 0.25
"""How much earlier than now a reading may have been made, or the dish be by its latency, in a stream."""
_STREAM_LATE_S = 0.03
_LOOSE_DEG = 0.02
"""How far a way that is no longer than the overshoot may end from where it began, `ROUND_DEG` aside."""


@dataclass(frozen=True, slots=True)
class _Moment:
    """Times by the clock, and how much faster the mechanics go."""

    last_at: float
    now: float
    rate: float


def foresee(
    motion: DishMotion, begun_by: dict[int, float], last: Position, last_at: float, now: float, rate: float
) -> Expected:
    """Return where each axis may be at `now`, from a reading `last` made at `last_at`.

    `begun_by` holds when an axis had taken its command at the latest, by its number, as far as that is known.
    """
    moment = _Moment(last_at, now, rate)
    axes = [
        _spans(motion.azimuth, last.azimuth, begun_by, moment),
        _spans(motion.elevation, last.elevation, begun_by, moment),
    ]
    if last.skew is not None:
        still = (AngleSpan(last.skew, last.skew, 0.0),)
        axes.append(still if motion.skew is None else _spans(motion.skew, last.skew, begun_by, moment))
    return Expected((motion.azimuth.started, motion.elevation.started), tuple(axes))


def _spans(axis: AxisMotion, last_deg: float, begun_by: dict[int, float], moment: _Moment) -> tuple[AngleSpan, ...]:
    slew, overshoot_deg = axis.slew, axis.axis.overshoot_deg
    if axis.streamed:
        return (_stream_span(axis, moment, overshoot_deg),)
    if not slew.segments:
        return (AngleSpan(last_deg - _LOOSE_DEG, last_deg + _LOOSE_DEG, 0.0),)
    here_deg = axis.read_deg + shortest_turn(axis.read_deg, last_deg)
    start_deg = slew.segments[0].position_deg
    spans = []
    if abs(slew.end_deg - start_deg) <= overshoot_deg + NEAR_DEG:
        # So short a way it may go not at all.
        spans.append(AngleSpan(here_deg - _LOOSE_DEG, here_deg + _LOOSE_DEG, 0.0))
    phase_s = _phase_s(slew, here_deg, overshoot_deg)
    if phase_s is not None and moment.last_at >= axis.started:
        past_s = moment.now - moment.last_at
        early_s, late_s = (max(0.0, past_s + sign * JITTER_S) * moment.rate + phase_s for sign in (-1, 1))
        spans.append(_span(slew, early_s, late_s, overshoot_deg, moment.rate))
        return tuple(spans)
    begun = max(begun_by.get(axis.axis.index, axis.started), axis.started)
    if begun == axis.started:
        begun += STOP_LATENCY_S
    span = _span(slew, (moment.now - begun) * moment.rate, (moment.now - axis.started) * moment.rate, overshoot_deg,
                 moment.rate)  # fmt: skip
    if span.high_deg - span.low_deg <= overshoot_deg + NEAR_DEG:
        spans.append(span)
    return tuple(spans)


def _stream_span(axis: AxisMotion, moment: _Moment, overshoot_deg: float) -> AngleSpan:
    """Return where an axis is that gets one target after the other, whether or not the dish has the latest yet."""
    slew, rate = axis.slew, moment.rate
    at_s = (moment.now - axis.started) * rate
    early_s, late_s = at_s - _STREAM_EARLY_S * rate, at_s + _STREAM_LATE_S * rate
    begins_deg, begins_deg_s = slew.at(0.0)
    angles = [slew.at(t_s)[0] for t_s in (early_s, (early_s + at_s) / 2, at_s, late_s)]
    if early_s < 0.0:
        angles.append(begins_deg + begins_deg_s * early_s)
    loose_deg = overshoot_deg + NEAR_DEG
    return AngleSpan(min(angles) - loose_deg, max(angles) + loose_deg, slew.at(at_s)[1] * rate)


def _span(slew: Slew, early_s: float, late_s: float, overshoot_deg: float, rate: float) -> AngleSpan:
    """Return where it is between two times on its way."""
    (early_deg, _), (late_deg, speed) = slew.at(early_s), slew.at(late_s)
    forward = slew.end_deg >= slew.segments[0].position_deg
    if late_s >= slew.duration_s:
        late_deg += overshoot_deg if forward else -overshoot_deg
    return AngleSpan(min(early_deg, late_deg), max(early_deg, late_deg), speed * rate)


def _phase_s(slew: Slew, here_deg: float, overshoot_deg: float) -> float | None:
    """Return how far on its way an axis is that is seen here; None if it may have not begun or have ended."""
    start_deg = slew.segments[0].position_deg
    way = slew.end_deg - start_deg
    clear_deg = overshoot_deg + NEAR_DEG
    gone = (here_deg - start_deg) * (1.0 if way >= 0 else -1.0)
    if not clear_deg < gone < abs(way) - clear_deg or any(part.velocity_deg_s * way < 0 for part in slew.segments):
        return None
    low, high = 0.0, slew.duration_s
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if abs(slew.at(middle)[0] - start_deg) < gone:
            low = middle
        else:
            high = middle
    return (low + high) / 2
