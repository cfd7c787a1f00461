"""Slews of a queued dish that do not go as asked: kept back by STOP, replaced, or refused."""

import pytest
from birdcage.base.errors import CommandRefused, Stopped
from birdcage.station.requests import Goto, Release, TurnSkew

from .queued_bench import connected


def test_a_skew_that_stop_kept_back_is_not_turned_by_the_next_slew():
    bench = connected("sk=90")
    protocol = bench.station._antenna.rotator.protocol
    send = protocol._send_move

    def stopped_just_before(motor, degrees, busy_s):
        bench.station.stop("you")
        return send(motor, degrees, busy_s)

    protocol._send_move = stopped_just_before
    with pytest.raises(Stopped):
        bench.do(TurnSkew(20.0, "you"))
    protocol._send_move = send
    bench.step(3.0)
    bench.do(Release("you"))
    since = bench.clock.monotonic()
    bench.do(Goto(290.0, 30.0, "you"), 60.0)
    assert bench.sent_moves(since) == ["g 290.00 30.00 90.00"]
    assert bench.device.truth().skew_deg == 90.0


def test_a_slew_replaced_many_times_is_ended_once():
    bench = connected()
    bench.station.submit(Goto(290.0, 30.0, "you"))
    bench.step(5.0)
    since = bench.clock.monotonic()
    for az_deg in range(100, 260, 20):
        bench.station.submit(Goto(float(az_deg), 40.0, "you"))
        bench.step(0.1)
    assert bench.sent_since(since).split(b"a\r")[0] == b"\r\r", "one Enter ends it, one proves the prompt"
    bench.step(40.0)
    truth = bench.device.truth()
    assert (truth.az_deg, truth.el_deg) == (240.0, 40.0)
    assert bench.state.fault is None


def test_a_slew_that_the_dish_refuses_ends_where_the_dish_says_that_it_is(monkeypatch):
    bench = connected()
    monkeypatch.setattr("birdcage.protocol.hal.protocol.angle_text", lambda _degrees: "x")
    asked = bench.station.submit(Goto(290.0, 30.0, "you"))
    bench.step(10.0)
    assert isinstance(asked.exception(0), CommandRefused)
    position = bench.state.position
    assert not position.modelled
    assert (position.az_deg, position.el_deg) == (180.0, 45.0)
