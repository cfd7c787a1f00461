"""Where STOP is not confirmed, what a person reads of it says to cut the power: in the report and in the app."""

from __future__ import annotations

import re

import pytest
from birdcage.base.errors import LinkError
from birdcage.station.report import status_report
from birdcage.station.requests import Goto, Home, Release
from birdcage.station.state import Activity
from birdcage.station.stop_pending import StopReach
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.panes.next_steps import next_steps
from birdcage_tui.shown.view import View

from .conftest import Bench

CUT = re.compile(r"[Cc]ut (its power|the power of the dish)")


def slewing(address="g2?seed=1&az_speed=20"):
    bench = Bench(address).connect()
    bench.do(Goto(60, 45, "you"))
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    assert bench.device.truth().moving
    return bench


def stopped_during(bench, request, activity):
    calls = []

    def press(event):
        if type(event).__name__ == "ActivityChanged" and event.activity is activity and not calls:
            calls.append(event)
            bench.station.stop("you")

    bench.station.subscribe(press)
    bench.station.submit(request)
    bench.step(2)


def takes_targets_at_the_end_only():
    bench = slewing("g2?seed=1&second_move=queue&az_speed=20")
    bench.station.stop("you")
    bench.step(0.1)
    while bench.state.last_stop.confirmed is None:
        bench.step(0.1)
    assert bench.device.truth().moving
    return bench


def is_known_to_do_so():
    bench = takes_targets_at_the_end_only()
    bench.step(20)
    bench.do(Release("you"))
    bench.station.submit(Goto(300, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(0.2)
    assert bench.device.truth().moving
    return bench


def does_not_answer():
    bench = slewing()
    bench.device.wire.to_host.silent = True
    bench.station.stop("you")
    bench.step(6)
    return bench


def is_not_there():
    bench = slewing()
    bench.device.unplug()
    bench.step(2)
    bench.station.stop("you")
    bench.step(0.2)
    return bench


def takes_no_bytes():
    bench = slewing()

    def fail(_data):
        raise LinkError("lost the port", reason="lost")

    bench.sim.write = fail
    bench.station.stop("you")
    bench.step(2)
    return bench


def is_unplugged_right_after():
    bench = slewing()
    bench.station.stop("you")
    bench.step(0.03)
    bench.device.unplug()
    bench.step(2)
    return bench


def homes():
    bench = Bench("g2?seed=1&unhomed=1").connect()
    stopped_during(bench, Home("you"), Activity.HOMING)
    return bench


def knows_no_position():
    bench = Bench("g2?seed=1&unhomed=1").connect()
    bench.station.stop("you")
    bench.step(3)
    return bench


SCENES = (
    takes_targets_at_the_end_only, is_known_to_do_so, does_not_answer, is_not_there, takes_no_bytes,
    is_unplugged_right_after, homes, knows_no_position,
)  # fmt: skip
SAYS_IT_IN_THE_APP = SCENES[:6]


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.__name__)
def test_a_stop_that_is_not_confirmed_names_the_power(scene):
    bench = scene()
    report = status_report(bench.state, bench.clock.monotonic())
    assert report["held"] is True
    told = report["last_stop"]
    assert told["confirmed"] is not True
    assert CUT.search(told["sentence"]), told
    steps = [words for _ink, words in next_steps(view_of(bench))]
    if scene in SAYS_IT_IN_THE_APP:
        assert CUT.search(" ".join(steps)), steps


def view_of(bench):
    return View(bench.state, bench.clock.monotonic(), bench.clock.utc(), AppOptions())


def test_one_that_is_confirmed_does_not():
    bench = slewing()
    bench.station.stop("you")
    bench.step(5)
    assert bench.state.last_stop.confirmed is True
    assert not CUT.search(bench.state.last_stop.sentence)
    assert not CUT.search(" ".join(words for _ink, words in next_steps(view_of(bench))))


def test_what_the_port_did_not_take_is_sent_again():
    bench = slewing()
    write, failures = bench.sim.write, [LinkError("takes no more bytes", reason="failed")]

    def fail_once(data):
        if failures:
            raise failures.pop()
        write(data)

    bench.sim.write = fail_once
    before = bench.device.truth().az_deg
    bench.station.stop("you")
    assert bench.station.stop_reach is StopReach.NOT
    bench.step(2)
    assert bench.station.stop_reach is StopReach.SENT
    assert not bench.device.truth().moving
    assert before < bench.device.truth().az_deg < before + 20
    bench.step(6)
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.sentence.startswith("Stands still at ")
