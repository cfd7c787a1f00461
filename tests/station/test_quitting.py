"""Once a program is on its way out, no line that moves the dish leaves it any more."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held, Stopped
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import Follow, Goto, Home, Jog, Raw, TurnSkew

from .conftest import Bench
from .queued_bench import connected
from .raw_console_bench import TalkBench

LATE = (Goto(90, 40, "you"), Follow(90, 40, "Gpredict"), Jog(5, 0, "you"), Home("you"))


@pytest.mark.parametrize("request_", LATE, ids=lambda request: type(request).__name__)
def test_a_request_that_comes_too_late_moves_nothing(bench, request_):
    bench.do(Goto(180, 45, "you"))
    since = bench.clock.monotonic()
    assert bench.station.bar() is False
    future = bench.station.submit(request_)
    bench.step(30)
    assert isinstance(future.exception(0), Held)
    assert bench.moves_since(since) == []
    assert bench.device.truth().az_deg == pytest.approx(180, abs=0.1)


@pytest.mark.parametrize("request_", [Goto(290, 30, "you"), Jog(4, 0, "you"), TurnSkew(20, "you")],
                         ids=lambda request: type(request).__name__)  # fmt: skip
def test_nor_where_moves_queue(request_):
    bench = connected()
    since = bench.clock.monotonic()
    bench.station.bar()
    future = bench.station.submit(request_)
    bench.step(60)
    assert isinstance(future.exception(0), Held)
    assert bench.sent_moves(since) == []


def test_a_raw_line_that_comes_too_late_is_kept():
    bench = TalkBench()
    since = bench.clock.monotonic()
    bench.station.bar()
    future = bench.station.submit(Raw("a 0 170", CONSOLE, confirmed=Grade.RUINS))
    bench.step(5)
    assert isinstance(future.exception(0), Held | Stopped)
    assert bench.moves_since(since) == []


def test_what_is_being_sent_when_the_program_leaves_goes_no_further():
    """The request is being served, and its position has just been asked for."""
    bench = Bench("g2?seed=1&latency_min=0.2&latency_max=0.21").connect()
    bench.step(10)
    since = bench.clock.monotonic()
    bench.later(0.1, bench.station.bar)
    future = bench.station.submit(Goto(90, 40, "you"))
    bench.step(10)
    assert isinstance(future.exception(0), Stopped)
    assert bench.moves_since(since) == []
