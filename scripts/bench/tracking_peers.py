"""How others follow, as controllers of ours: the same wire, the same latency, the same dish.

They are given the satellite's path, not a plan, and send azimuths of 0 to 360 degrees, as they do.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.base.geometry import wrap_360
from birdcage.leapfrog import apply_leapfrog
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.steps import ReadPosition, Send, Steps, Wait

TICK_S = 1.0


def _clamped(helm: ControllerInput, el_deg: float) -> float:
    axis = helm.model.elevation
    return min(max(el_deg, axis.min_deg), axis.max_deg)


def _seen_from(helm: ControllerInput, t_s: float) -> tuple[float, float]:
    az, el = helm.course().at(t_s)
    return wrap_360(az), el


def _both(helm: ControllerInput, az_deg: float, el_deg: float, *, az_first: bool) -> Steps:
    order = [(helm.model.azimuth.index, wrap_360(az_deg)), (helm.model.elevation.index, _clamped(helm, el_deg))]
    for index, deg in order if az_first else reversed(order):
        yield Send(index, deg)


def move_to_now(tolerance_deg: float, *, leapfrog: bool) -> Controller:
    """Once a second: where is it, is the dish off by more than the tolerance, then go there."""

    def follow(helm: ControllerInput) -> Steps:
        now_s, az_first = helm.now_s, True
        while now_s < helm.until_s:
            seen = yield ReadPosition()
            az, el = _seen_from(helm, now_s)
            el = _clamped(helm, el)
            was = wrap_360(seen.az_deg or 0.0), seen.el_deg or 0.0
            if abs(az - was[0]) > tolerance_deg or abs(el - was[1]) > tolerance_deg:
                if leapfrog:
                    az, el = apply_leapfrog(az, el, *was)
                yield from _both(helm, az, el, az_first=az_first or not leapfrog)
                az_first = not az_first
            now_s = (yield Wait(now_s + TICK_S)).now_s

    return follow


def gpredict(tolerance_deg: float, *, leapfrog: bool) -> Controller:
    """Gpredict's (gtk-rot-ctrl.c): a tick each second, and beside it a client that is busy half of the time at most.

    Where the error has reached the tolerance it sends the point at which the error will have reached it again.
    """

    def ahead(helm: ControllerInput, now_s: float, rot: tuple[float, float]) -> tuple[float, float] | None:
        az, el = _seen_from(helm, now_s)
        clamped = _clamped(helm, el)
        if not (abs(az - wrap_360(rot[0])) > tolerance_deg or abs(clamped - rot[1]) > tolerance_deg):
            return None
        found, span_s = (az, el), helm.until_s - now_s
        step_s = max(span_s / 2.0, TICK_S)
        while step_s > TICK_S / 4.0:
            found = _seen_from(helm, now_s + span_s)
            off = abs(az - found[0]) > tolerance_deg or abs(clamped - found[1]) > tolerance_deg
            span_s += -step_s if off else step_s
            step_s /= 2.0
        return found[0], _clamped(helm, found[1])

    def follow(helm: ControllerInput) -> Steps:
        now_s, az_first = helm.now_s, True
        rot = wrap_360(helm.start_az_deg), helm.start_el_deg
        target: tuple[float, float] | None = None
        tick_s = math.floor(now_s)
        while now_s < helm.until_s:
            while tick_s <= now_s:
                target = ahead(helm, tick_s, rot) or target
                tick_s += TICK_S
            began_s = now_s
            if target is not None:
                az, el = round(target[0], 2), round(target[1], 2)
                if leapfrog:
                    az, el = apply_leapfrog(az, el, *rot)
                yield from _both(helm, az, el, az_first=az_first or not leapfrog)
                az_first, target = not az_first, None
            now_s = (yield Wait(began_s + 0.1)).now_s
            seen = yield ReadPosition()
            rot = wrap_360(seen.az_deg or 0.0), seen.el_deg or 0.0
            now_s = (yield Wait(seen.now_s + max(seen.now_s - began_s, 0.7))).now_s

    return follow


PEERS: dict[str, Callable[[], Controller]] = {
    "Gpredict, 5°": lambda: gpredict(5.0, leapfrog=False),
    "Gpredict, 5°, leapfrog": lambda: gpredict(5.0, leapfrog=True),
    "Gpredict, 1°": lambda: gpredict(1.0, leapfrog=False),
    "Gpredict, 1°, leapfrog": lambda: gpredict(1.0, leapfrog=True),
    "move to now, 1 Hz": lambda: move_to_now(0.0, leapfrog=False),
    "move to now, 1 Hz, leapfrog": lambda: move_to_now(0.0, leapfrog=True),
}
