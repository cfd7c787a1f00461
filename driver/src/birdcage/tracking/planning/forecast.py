"""The pointing error to expect: how far the course is from the sky, and the saw-tooth of commands one after another."""

from __future__ import annotations

import numpy as np

from birdcage.protocol.model import DishModel
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.move_times import durations
from birdcage.tracking.plan import Forecast
from birdcage.tracking.planning.itinerary import Stretch
from birdcage.tracking.planning.sight import Sight

LATENCY_S = 0.06
"""From sending a command to its effect, before it was measured: the middle of 20 to 100 ms (SEAMS *Figures*)."""
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


def forecast(sight: Sight, stretches: tuple[Stretch, ...], course: Curve, beam_deg: float | None) -> Forecast:
    """Return the error to expect while following, from the course alone."""
    t = following_times(stretches)
    az, el = course.sample(t)
    sky_az, sky_el = sight.dish.sample(t)
    off = separations_deg(az, el, sky_az, sky_el)
    saw, peaks = saw_tooth_deg(sight.mount.model, course, t, stretches)
    return made(t, np.hypot(off, saw), beam_deg, peak_deg=float(np.hypot(off, peaks).max()))


def made(t: Floats, error_deg: Floats, beam_deg: float | None, peak_deg: float | None = None) -> Forecast:
    """Return a forecast of errors at times; where they are averages, `peak_deg` is the greatest single one."""
    loss = loss_db(error_deg, beam_deg)
    greatest = float(error_deg.max()) if peak_deg is None else peak_deg
    return Forecast(t, error_deg, loss, float(np.sqrt(np.mean(error_deg**2))), greatest)


def loss_db(error_deg: Floats, beam_deg: float | None) -> Floats | None:
    """Return what errors cost at a beam so wide at half power; None without one (reference section 5)."""
    return None if beam_deg is None else 12.0 * (error_deg / beam_deg) ** 2


def following_times(stretches: tuple[Stretch, ...], step_s: float = _STEP_S) -> Floats:
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


def saw_tooth_deg(model: DishModel, course: Curve, t: Floats, stretches: tuple[Stretch, ...]) -> tuple[Floats, Floats]:
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
    rate = np.hypot(across * narrow, up)
    interval = _interval_s(model, across, up)
    steps = (model.azimuth.step_deg * narrow) ** 2 + model.elevation.step_deg**2
    if model.azimuth.times is None:
        mean_s: Floats = np.hypot(interval / 12.0**0.5, _UNSURE_S[model.moves_in_turn])
        most_s: Floats = interval / 2.0 + _LATE_S
    else:
        mean_s, most_s = _UNDER_WAY * interval, interval / 2.0
    # An axis comes to rest anywhere up to its overshoot off the command.
    loose = (model.azimuth.overshoot_deg * narrow) ** 2 + model.elevation.overshoot_deg**2
    return (
        np.hypot(rate * mean_s, np.sqrt(steps / 12.0 + loose / 3.0)),
        rate * most_s + np.sqrt(steps) / 2.0 + np.sqrt(loose),
    )


def _interval_s(model: DishModel, across: Floats, up: Floats) -> Floats:
    """Return how long it takes until an axis is sent again."""
    one_s = LATENCY_S + _LINE_BITS / model.baud
    interval = np.full(len(across), 2.0 * one_s)
    if not model.moves_in_turn:
        return interval
    for _ in range(12):
        interval = np.maximum(
            2.0 * one_s,
            durations(model.azimuth, across * interval) + durations(model.elevation, up * interval),
        )
    # Where the azimuth has no time to spare it lags on average by what the course has left for it.
    capped: Floats = np.minimum(interval, 8.0)
    return capped
