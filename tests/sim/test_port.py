"""The port as the driver's link uses it."""

from __future__ import annotations

import math
import threading

import pytest
from birdcage.base.clock import RealClock, ScaledClock, VirtualClock
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.port import open_port
from birdcage.sim.settings import option_names


def test_the_port(terminal):
    port = terminal().port
    assert (port.name, port.demo, port.fileno()) == ("sim:g2", True, None)
    assert port.next_event() == math.inf
    assert not port.pending()
    assert port.read() == b""


def test_discard_and_close(terminal):
    dish = terminal()
    dish.type("mot\r")
    dish.clock.advance(1.0)
    dish.port.discard()
    assert dish.listen(1.0) == ""
    dish.port.close()
    dish.port.close()
    dish.port.discard()
    with pytest.raises(ConnectionError):
        dish.port.write(b"x")


@pytest.mark.parametrize(
    ("address", "hint"),
    [
        ("g3", "did you mean g2"),
        ("", "there is .*g2"),
        ("g2?secondmove=queue", "did you mean second_move"),
        ("g2?zzz=1", "root_q"),
        ("g2?root_q=die", "error, ignore, kill"),
        ("g2?seed=one", "whole number"),
        ("g2?overshoot=much", "a number"),
        ("g2?boot=perhaps", "1 or 0"),
        ("g2?boot", "bad query"),
    ],
)
def test_addresses_that_do_not_exist(address, hint):
    with pytest.raises(ValueError, match=hint):
        open_port(address, clock=VirtualClock())


def test_every_choice_opens(terminal):
    for name, values in G2Settings.choices.items():
        assert name in option_names(G2Settings)
        assert getattr(G2Settings(), name) in values
        for value in values:
            assert terminal(f"{name}={value}").ask("").endswith("TRK>")


def test_the_same_seed_gives_the_same_dish(terminal):
    def session(seed):
        dish = terminal(f"seed={seed}&drop=0.05&boot=1&nvs20=0")
        return dish.listen(30) + dish.ask("mot") + dish.ask("a 0 200") + dish.ask("dvb") + dish.ask("rssi 5")

    assert session(4) == session(4)
    assert session(4) != session(5)


def test_real_and_scaled_clocks_with_a_writer_in_another_thread():
    for clock in (RealClock(), ScaledClock(50.0)):
        port = open_port("g2?latency_min=0.001&latency_max=0.002", clock=clock)
        writers = [threading.Thread(target=port.write, args=(b"mot\r",)) for _ in range(4)]
        for writer in writers:
            writer.start()
        for writer in writers:
            writer.join()
        heard, end = b"", clock.monotonic() + 5.0
        while heard.count(b">") < 4 and clock.monotonic() < end:
            clock.wait(port, end)
            heard += port.read()
        assert heard.count(b">") == 4
