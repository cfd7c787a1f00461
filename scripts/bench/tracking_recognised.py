"""Gpredict's policy as a client of a server that recognises its satellite: from there on the dish goes by our plan.

It begins where the satellite comes into reach. A real Gpredict begins at the horizon, so it is recognised sooner.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from functools import cache

from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import Fleet
from birdcage.sky.recognition import AskedDirection, recognise
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.curve import Curve
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steps import Send, Step, StepResult, Steps
from made_up import made_up
from tracking_passes import Case
from tracking_peers import gpredict

OTHERS = 3000
"""Made-up satellites beside the one that is followed."""


@cache
def _fleet(satellite: ElementSet) -> Fleet:
    return Fleet([satellite, *made_up(OTHERS, satellite.epoch)])


def recognised(peer: Controller, case: Case, course: Curve) -> Controller:
    """Return a peer that moves the dish by its own steps until its satellite is recognised; `course` is our plan's."""

    def follow(helm: ControllerInput) -> Steps:
        az_axis, el_axis = helm.model.azimuth.index, helm.model.elevation.index
        steps, wished, asked = peer(helm), dict[int, float](), list[AskedDirection]()
        place, answer = (helm.start_az_deg, helm.start_el_deg), StepResult(helm.now_s)
        step: Step = next(steps)
        while True:
            if isinstance(step, Send):
                wished[step.axis] = step.deg
                if len(wished) == 2:
                    asked.append(AskedDirection(answer.now_s, wrap_360(wished[az_axis]), wished[el_axis]))
                    place = _on_our_turn(wished[az_axis], course, answer.now_s), wished[el_axis]
                    wished.clear()
                    yield Send(az_axis, round(place[0], 2))
                    answer = yield Send(el_axis, round(place[1], 2))
                    if _is_recognised(asked, case.satellite, case.observer):
                        break
            else:
                answer = yield step
            try:
                step = steps.send(answer)
            except StopIteration:
                return
        yield from _by_plan(helm, course, place, answer.now_s)

    return follow


def _by_plan(
    helm: ControllerInput, course: Curve, place: tuple[float, float], now_s: float
) -> Generator[Step, StepResult, None]:
    yield from fast(ControllerInput(lambda: course, helm.model, *place, now_s, helm.until_s, helm.latency_s))


def _on_our_turn(az_deg: float, course: Curve, now_s: float) -> float:
    """Return an azimuth as the server sends it: on the turn of the cable on which the dish is."""
    here = course.at(now_s)[0]
    return here + shortest_turn(here, az_deg)


def _is_recognised(asked: list[AskedDirection], satellite: ElementSet, observer: Observer) -> bool:
    found = recognise(_fleet(satellite), observer, asked)
    if found is not None and found.index != 0:
        raise SystemExit(f"{satellite.name} was taken for another satellite")
    return found is not None


RECOGNISED: dict[str, Callable[[Case, Curve], Controller]] = {
    f"Gpredict, {threshold:g}°, recognised": lambda case, course, threshold=threshold: recognised(  # type: ignore[misc]
        gpredict(threshold, leapfrog=False), case, course
    )
    for threshold in (5.0, 1.0)
}
