"""Every fault of the wire, one by one."""

from __future__ import annotations

import pytest
from birdcage.base.clock import WaitOutcome
from birdcage.sim.wire import DOUBLE, DROP, PASS, Byte


def test_silence_each_way(terminal):
    dish = terminal()
    dish.port.wire.to_host.silent = True
    assert dish.ask("mot") == ""
    assert dish.port.dish.truth().menu == "mot"
    dish.port.wire.to_host.silent = False
    dish.port.wire.to_dish.silent = True
    assert dish.ask("q") == ""
    dish.port.wire.to_dish.silent = False
    assert dish.ask("q") == "q\r\nTRK>"


def test_dropped_bytes(terminal):
    dish = terminal()
    dish.port.wire.to_host.drop = 0.5
    heard = dish.ask("?")
    whole = terminal().ask("?")
    assert 0.2 * len(whole) < len(heard) < 0.8 * len(whole)
    letters = iter(whole)
    assert all(letter in letters for letter in heard)  # a subsequence


def test_doubled_bytes(terminal):
    dish = terminal()
    dish.port.wire.to_host.double = 1.0
    assert dish.ask("mot") == "mmoott\r\r\n\nMMOOTT>>"


def test_garbage(terminal):
    dish = terminal()
    dish.port.wire.to_host.garble = 1.0
    assert "TRK>" not in dish.ask("")


def test_faults_from_the_address(terminal):
    assert terminal("double=1").port.wire.to_dish.double == 1.0
    assert terminal("drop=1").ask("mot") == ""


def test_delays_keep_the_order(terminal):
    dish = terminal()
    lane = dish.port.wire.to_host
    lane.delay_min_s, lane.delay_max_s = 0.1, 2.0
    dish.type("mot\r")
    start = dish.now
    assert dish.listen(0.09) == ""
    assert dish.listen(10.0) == "mot\r\nMOT>"
    assert dish.clock.wait(dish.port, dish.now) is WaitOutcome.TIMEOUT
    dish.port.wire.to_dish.delay_max_s = 2.0
    dish.type("q\r")
    dish.listen(10.0)
    assert dish.port.received[-1][0] > start + 10.0


def test_a_plan_says_what_happens_to_each_byte(terminal):
    dish = terminal()
    dish.port.wire.to_dish.set_plan([PASS, DROP, PASS, DOUBLE, PASS])  # "mXot" + CR: X is lost, t is doubled
    dish.type("mxot\r")
    assert dish.listen(1.0) == "mott\r\nInvalid command.\r\nTRK>"


def test_a_plan_delays_and_adds_noise(terminal):
    dish = terminal("latency_min=0&latency_max=0")
    dish.port.wire.to_host.set_plan([Byte(noise=b"~~"), Byte(delay_s=0.5)])
    dish.type("mot\r")
    assert dish.listen(0.4) == "~~m"
    assert dish.listen(0.2) == "ot\r\nMOT>"


def test_a_plan_may_be_a_function(terminal):
    dish = terminal()
    dish.port.wire.to_host.set_plan(lambda value: DROP if value == ord(">") else PASS)
    assert dish.ask("mot") == "mot\r\nMOT"
    dish.port.wire.to_host.set_plan(None)
    assert dish.ask("") == "\r\nMOT>"


def test_echo_loss(terminal):
    dish = terminal()
    dish.port.wire.echo_loss = True
    assert dish.ask("mot") == "MOT>"


def test_pacing_at_a_baud_rate(terminal):
    dish = terminal("pace_baud=9600&latency_min=0&latency_max=0")
    start = dish.now
    reply = dish.ask("", "TRK>")
    assert dish.now - start == pytest.approx((1 + len(reply)) * 10 / 9600, abs=1e-6)


def test_pacing_is_real_whatever_the_rate(terminal):
    dish = terminal("pace_baud=9600", rate=50.0)
    start = dish.now
    reply = dish.ask("", "TRK>")
    assert dish.now - start >= len(reply) * 10 / 9600


def test_unplugging_and_return(terminal):
    dish = terminal("id=pulled")
    dish.ask("mot", "MOT>")
    dish.ask("a 0 200", "MOT>")
    dish.device.unplug()
    assert dish.port.pending()
    for use in (dish.port.read, lambda: dish.port.write(b"a\r")):
        with pytest.raises(ConnectionError, match="the wire is gone"):
            use()
    with pytest.raises(ConnectionError):
        terminal("id=pulled")
    dish.clock.advance(5.0)
    dish.device.plug()
    with pytest.raises(ConnectionError):
        dish.port.read()  # a port that was lost stays lost
    again = type(dish.port)(dish.device, "sim:g2")
    again.write(b"a\r")
    dish.port = again
    assert "Angle[0] = 199." in dish.listen(1.0) or "Angle[0] = 200." in dish.listen(1.0)


def test_what_came_while_no_port_was_open_is_lost(terminal):
    dish = terminal("id=closed")
    dish.type("mot\r")
    dish.port.close()
    dish.clock.advance(1.0)
    dish.port = type(dish.port)(dish.device, "sim:g2")
    assert dish.ask("") == "\r\nMOT>"


def test_what_is_said_while_unplugged_is_lost(terminal):
    dish = terminal()
    dish.device.unplug()
    dish.device.reboot()
    dish.clock.advance(60.0)
    dish.device.plug()
    dish.port = type(dish.port)(dish.device, "sim:g2")
    assert dish.listen(1.0) == ""


def test_deadlock_is_silence_until_power_on(terminal):
    dish = terminal()
    dish.ask("mot", "MOT>")
    dish.ask("a 0 200", "MOT>")
    dish.device.deadlock()
    assert dish.ask("a") == ""
    assert not dish.port.dish.truth().shell_alive
    dish.listen(3.0)
    assert dish.port.dish.truth().az_deg == pytest.approx(200, abs=0.07)  # the motors went on
    dish.device.power_cycle()
    assert dish.listen(30.0).endswith("TRK>")
