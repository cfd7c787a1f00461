"""A pursuit with a dish that takes no command before its motor rests: known to, or found out."""

from __future__ import annotations

import pytest
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase

from .pursuit_bench import PARK, PursuitBench, at, plan_of
from .test_waiting_dish import busy_told

WAITS = "g2?seed=1&second_move=block&second_other=block"


def backlog(bench):
    """The most lines that have waited for their answers at one time, by when they left and when they were read."""
    return max(bench.owed, default=0)


def connected(address=WAITS + "&az=-180"):
    bench = PursuitBench(address).connect()
    bench.watch("position")
    bench.step(2.0)
    bench.owed = []
    console = bench.station._antenna.rotator.protocol.console
    send = console._wire.send

    def sending(line, takes_s=0.0, permit=None):
        ticket = send(line, takes_s, permit)
        bench.owed.append(console.owed)
        return ticket

    console._wire.send = sending
    return bench


@pytest.mark.parametrize("known", [True, False])
def test_a_pass_is_followed_and_the_dish_is_never_called_silent(known):
    bench = connected()
    if known:
        bench.do(Goto(0, 30, "you"))
    told = len(busy_told(bench))
    bench.pursue(plan_of(at(bench) + 60.0), **PARK)
    bench.until(Phase.FOLLOWING)
    bench.step(5)
    assert bench.pursuit.controller == "queued", "it moves one axis after the other"
    bench.until(Phase.OVER)
    assert bench.pursuit.rms_error_deg < 0.1
    assert bench.pursuit.max_error_deg < 0.5
    assert backlog(bench) <= 1
    assert bench.state.fault is None
    assert bench.state.held is None
    assert not [e for e in bench.events if type(e).__name__ == "LinkChanged" and e.link.state is LinkPhase.SILENT]
    assert len(busy_told(bench)) - told <= (0 if known else 1)


def test_a_pass_that_begins_where_the_dish_stands_is_followed_with_what_is_known_and_builds_no_backlog():
    """Its moves are short: no answer is late enough to tell."""
    bench = connected(WAITS + "&az=-260&el=30")
    bench.pursue(plan_of(at(bench) + 3.0), **PARK)
    bench.until(Phase.FOLLOWING)
    bench.until(Phase.OVER)
    assert bench.pursuit.rms_error_deg < 0.15
    assert backlog(bench) <= 3
    assert bench.state.fault is None
    assert bench.state.held is None


def test_stop_in_mid_pass_aims_at_nothing_and_the_dish_rests_within_a_move():
    bench = connected()
    bench.pursue(plan_of(at(bench) + 60.0), **PARK)
    bench.until(Phase.FOLLOWING)
    bench.step(20)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(3.0)
    assert bench.moves_since(since + 0.1) == []
    assert not bench.device.truth().moving
    assert bench.state.last_stop.confirmed is True
    assert bench.pursuit.phase is Phase.OVER
