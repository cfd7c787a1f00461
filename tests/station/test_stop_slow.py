"""STOP of a dish whose motors were set to go slowly: it is confirmed when the dish rests, and not before."""

from __future__ import annotations

import pytest
from birdcage.station.events import StopConfirmed
from birdcage.station.requests import Goto, Release
from birdcage.station.stop_words import stop_line

from .conftest import Bench

SPEEDS_DEG_S = (0.02, 0.1, 0.2, 0.3, 0.5, 1.0, 5.0)


def stopped(speed_deg_s: float, *, survey: bool) -> tuple[Bench, list[bool], float]:
    """Return a bench, whether the dish moved at each confirmation, and how long that took."""
    bench = Bench(f"g2?seed=1&az_speed={speed_deg_s}&az=-180", {"survey": survey}).connect()
    bench.watch("position", rate_hz=2.0)
    bench.step(4.0)
    moved: list[bool] = []

    def hear(event: object) -> None:
        if isinstance(event, StopConfirmed) and event.report.confirmed:
            moved.append(bench.device.truth().moving)

    bench.station.subscribe(hear)
    position = bench.state.position
    assert position is not None
    bench.station.submit(Goto(position.az_deg + 40.0, position.el_deg, "you"))
    bench.step(1.0)
    assert bench.device.truth().moving
    before = bench.clock.monotonic()
    bench.station.stop("you")
    while not moved and bench.clock.monotonic() < before + 16.0:
        bench.step(0.05)
    return bench, moved, bench.clock.monotonic() - before


@pytest.mark.parametrize("speed_deg_s", SPEEDS_DEG_S)
def test_a_speed_that_is_known_is_allowed_for(speed_deg_s):
    bench, moved, took_s = stopped(speed_deg_s, survey=True)
    assert moved == [False]
    assert took_s < 1.0 or speed_deg_s < 0.1
    assert bench.state.last_stop.sentence.startswith("Stands still at ")


@pytest.mark.parametrize("speed_deg_s", SPEEDS_DEG_S)
def test_a_speed_that_is_not_known_may_be_the_least_that_can_be_set(speed_deg_s):
    _bench, moved, took_s = stopped(speed_deg_s, survey=False)
    assert True not in moved
    assert moved or speed_deg_s <= 1.0, "it is far from its aim, and goes on"
    assert took_s < 1.0 or speed_deg_s < 5.0, "it was seen to be faster"


@pytest.mark.parametrize(("lane", "delay_s"), [("to_host", 1.6), ("to_dish", 0.9), ("to_dish", 1.9)])
def test_a_line_that_turns_slow_does_not_speak_against_a_rung(lane, delay_s):
    """The dish takes every new target; its answers, or what it is sent, are late. The next STOP sends one again."""
    bench = Bench("g2?seed=1&az_speed=60").connect()
    bench.watch("position")
    bench.do(Goto(60, 45, "you"))
    bench.station.submit(Goto(300, 45, "you"))
    bench.step(1.5)
    slow = getattr(bench.device.wire, lane)
    bench.later(0.02, lambda: [setattr(slow, end, delay_s) for end in ("delay_min_s", "delay_max_s")])
    bench.station.stop("you")
    bench.step(20)
    assert bench.state.last_stop.sentence.startswith("Stands still at ")
    slow.delay_min_s = slow.delay_max_s = 0.0
    bench.do(Release("you"))
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(5)
    assert (bench.state.last_stop.means, bench.state.last_stop.confirmed) == ("retarget", True)
    assert not bench.device.truth().moving


def test_a_dish_that_had_arrived_has_shown_nothing_of_what_stops_it():
    bench = Bench("g2?seed=1&az_speed=20").connect()
    bench.watch("position")
    bench.do(Goto(60, 45, "you"))
    bench.station.submit(Goto(80, 45, "you"))
    bench.step(0.3)
    while bench.device.truth().moving:
        bench.step(0.01)
    assert bench.state.motion is not None, "it was not seen there yet"
    bench.station.stop("you")
    bench.step(5)
    assert (bench.state.last_stop.means, bench.state.last_stop.confirmed) == ("retarget", True)
    bench.do(Release("you"))
    for said in ("STOP should take ", "STOP takes "):
        bench.station.submit(Goto(200 if said == "STOP should take " else 60, 45, "you"))
        bench.step(1)
        assert stop_line(bench.state, bench.clock.monotonic()).startswith(said)
        bench.station.stop("you")
        bench.step(5)
        bench.do(Release("you"))
