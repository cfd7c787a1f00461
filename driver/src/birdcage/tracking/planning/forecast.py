"""The pointing error to expect: how far the course is from the sky, and the saw-tooth of commands one after another."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from birdcage.base.beam import PEAK_LOSS_DB, Beam
from birdcage.rotator.facts import Facts
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.move_times import durations
from birdcage.tracking.plan import Forecast
from birdcage.tracking.planning.itinerary import TrackSegment
from birdcage.tracking.planning.target_track import TargetTrack

LATENCY_S = 0.06
"""From sending a command to its effect, before it was measured: the middle of 20 to 100 ms, which are assumed."""
_LINE_BITS = 400.0
"""A command, its echo and its reply, with start and stop bits."""
_UNSURE_S = {False: 0.04, True: 0.065}
"""How much the moment at which a move takes effect varies, beside the saw-tooth itself: latency, which of both axes is
due, readings in between. Of axes that move together, and in turn; from rehearsals and from the benchmark, whole passes
of each: what is forecast is what they show, or up to a half more."""
_LATE_S = 0.16
"""How much later than half an interval on the mean the latest of some hundred moves is; measured with the same."""
_UNDER_WAY = 0.21
"""What of its interval a dish is off on the mean, where a move takes all of it: it is under way all the while."""
_RESTS_S = 0.9
"""The longest from the end of a move of all axes until the next one begins: the proof that it is over, looks that are a
tenth of a second apart, and two lines."""
_LOOKS_PER_S = 1.0
"""How often a dish is asked where it is while it follows, about."""
_STEP_S = 0.5
_ABOUT_S = 0.25
_MOST = 2000


def separations_deg(az1: Floats, el1: Floats, az2: Floats, el2: Floats) -> Floats:
    """Return the angles on the sky between directions."""
    first, second = np.radians(el1), np.radians(el2)
    half = np.sin((second - first) / 2.0) ** 2
    half += np.cos(first) * np.cos(second) * np.sin(np.radians(az2 - az1) / 2.0) ** 2
    angles: Floats = np.degrees(2.0 * np.arcsin(np.sqrt(np.clip(half, 0.0, 1.0))))
    return angles


def offsets_deg(az1: Floats, el1: Floats, az2: Floats, el2: Floats) -> Offsets:
    """Return how far the second directions lie to the right of the first and above, as `base.geometry.offset`."""
    first, second, turn = np.radians(el1), np.radians(el2), np.radians(az2 - az1)
    right = np.cos(second) * np.sin(turn)
    up = np.cos(first) * np.sin(second) - np.sin(first) * np.cos(second) * np.cos(turn)
    aside = np.hypot(right, up)
    scale = np.divide(separations_deg(az1, el1, az2, el2), aside, out=np.zeros_like(aside), where=aside > 0.0)
    return Offsets(right * scale, up * scale)


class Offsets(NamedTuple):
    """Errors by their directions on the sky: one way or the other, or the root mean square of both."""

    across_deg: Floats
    """Across the line of sight, not in azimuth."""
    up_deg: Floats

    @property
    def size_deg(self) -> Floats:
        """How far off that is."""
        size: Floats = np.hypot(self.across_deg, self.up_deg)
        return size

    def and_at_random(self, other: Offsets) -> Offsets:
        """Return the root mean squares of both together, which have nothing to do with each other."""
        return Offsets(np.hypot(self.across_deg, other.across_deg), np.hypot(self.up_deg, other.up_deg))

    def loss_db(self, beam: Beam) -> Floats:
        """Return what is lost by them; of root mean squares, on the mean."""
        lost: Floats = PEAK_LOSS_DB * ((self.across_deg / beam.az_deg) ** 2 + (self.up_deg / beam.el_deg) ** 2)
        return lost


def forecast(track: TargetTrack, stretches: tuple[TrackSegment, ...], course: Curve, beam: Beam | None) -> Forecast:
    """Return the error to expect while following, from the course alone."""
    t = following_times(stretches)
    off = offsets_deg(*track.dish.sample(t), *course.sample(t))
    saw, peaks = saw_tooth_deg(track.mount.model, course, t, stretches)
    return made(t, off.and_at_random(saw), beam, peak_deg=float(np.hypot(off.size_deg, peaks).max()))


def made(t: Floats, off: Offsets, beam: Beam | None, peak_deg: float | None = None) -> Forecast:
    """Return a forecast of errors at times; where they are averages, `peak_deg` is the greatest single one."""
    error_deg, loss = off.size_deg, None if beam is None else off.loss_db(beam)
    greatest = float(error_deg.max()) if peak_deg is None else peak_deg
    return Forecast(t, error_deg, loss, float(np.sqrt(np.mean(error_deg**2))), greatest)


def following_times(stretches: tuple[TrackSegment, ...], step_s: float = _STEP_S) -> Floats:
    """Return times at even steps within the stretches, their ends among them."""
    step_s = max(step_s, sum(one.end_s - one.start_s for one in stretches) / _MOST)
    return np.unique(
        np.concatenate(
            [
                np.linspace(one.start_s, one.end_s, max(2, round((one.end_s - one.start_s) / step_s) + 1))
                for one in stretches
            ]
        )
    )


def saw_tooth_deg(
    model: Facts, course: Curve, t: Floats, stretches: tuple[TrackSegment, ...]
) -> tuple[Offsets, Floats]:
    """Return what is left between two commands, on the sky: its root mean square, and the greatest to expect.

    Commands that name where the target will be half an interval later leave a saw-tooth of rate x interval, and the
    quantisation of the steps.
    """
    before, after = t - _ABOUT_S, t + _ABOUT_S
    for one in stretches:
        inside = (t >= one.start_s) & (t <= one.end_s)
        before, after = (
            np.where(inside, np.maximum(before, one.start_s), before),
            np.where(inside, np.minimum(after, one.end_s), after),
        )
    (az, el), (before_az, before_el) = course.sample(after), course.sample(before)
    across, up = np.abs(az - before_az) / (after - before), np.abs(el - before_el) / (after - before)
    narrow = np.cos(np.radians(np.clip(el, 0.0, 90.0)))
    rests_s = 0.0 if model.moves_one_axis else _RESTS_S
    interval = _interval_s(model, across, up, rests_s)
    rates = Offsets(across * narrow, up)
    steps = Offsets(model.azimuth.step_deg * narrow, np.full(len(t), model.elevation.step_deg))
    if not model.moves_one_axis:
        # How fast it is, and whether its axes go at once, is not known: it may have been there all the while.
        early_s = (interval - rests_s) / 2.0
        mean_s: Floats = np.hypot(interval / 12.0**0.5, np.hypot(early_s, _UNSURE_S[True]))
        most_s: Floats = interval / 2.0 + early_s + _LATE_S
    elif model.azimuth.times is None:
        mean_s = np.hypot(interval / 12.0**0.5, _UNSURE_S[model.moves_in_turn])
        most_s = interval / 2.0 + _LATE_S
    else:
        mean_s, most_s = _UNDER_WAY * interval, interval / 2.0
    # An axis comes to rest anywhere up to its overshoot off the command.
    loose = Offsets(model.azimuth.overshoot_deg * narrow, np.full(len(t), model.elevation.overshoot_deg))
    mean = Offsets(
        *(
            np.hypot(rate * mean_s, np.sqrt(step**2 / 12.0 + rest**2 / 3.0))
            for rate, step, rest in zip(rates, steps, loose, strict=True)
        )
    )
    return mean, rates.size_deg * most_s + steps.size_deg / 2.0 + loose.size_deg


def _interval_s(model: Facts, across: Floats, up: Floats, rests_s: float) -> Floats:
    """Return how long it takes until an axis is sent again; `rests_s`: how long the dish stands before."""
    pace_s = model.least_line_interval_s or 0.0
    one_s = max(LATENCY_S + model.bits_s(_LINE_BITS), pace_s)
    interval = np.full(len(across), 2.0 * one_s)
    if not model.moves_in_turn:
        return interval
    for _ in range(12):
        interval = np.maximum(
            2.0 * one_s,
            durations(model.azimuth, across * interval) + durations(model.elevation, up * interval) + rests_s,
        )
    # Where the azimuth has no time to spare it lags on average by what the course has left for it. A dish that takes
    # its time even for the least way is never sooner than that.
    least = np.full(1, 1e-6)
    least_s = float((durations(model.azimuth, least) + durations(model.elevation, least))[0])
    # Each look stands between two commands, and puts the second one off where both gaps do not fit in.
    put_off_s = np.maximum(2.0 * pace_s - interval / 2.0, 0.0) * _LOOKS_PER_S * interval
    capped: Floats = np.minimum(interval + put_off_s, max(8.0, 2.0 * least_s))
    return capped
