"""The station drives a dish that it has never met."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase

from .bench import Bench


@pytest.mark.parametrize(
    "habits",
    [
        {}, {"eol": "\n"}, {"eol": "\r"}, {"eol": "\n\r"}, {"colour": True}, {"prompts": "spaced"}, {"echo": "lower"},
        {"echo_while_busy": True}, {"decimals": 0}, {"decimals": 4}, {"pieces": True}, {"half_duplex": True},
        {"latency_s": 0.3}, {"latency_s": 1.5}, {"jitter_s": 0.4}, {"chatter_s": 0.5}, {"chatter_in_reply": 0.5},
        {"root_q": "dies"}, {"root_q": "unknown"}, {"unknown_text": ""}, {"sleep_s": 60.0}, {"overshoot_deg": 0.05},
    ],
    ids=str,
)  # fmt: skip
def test_it_points_a_dish_that_shares_no_code_with_our_simulator(habits):
    bench = Bench(**habits).connect()
    bench.do(Goto(200.0, 30.0, "you"))
    bench.step(3.0)
    assert bench.dish.where() == (pytest.approx(200.0, abs=0.06), pytest.approx(30.0, abs=0.06))
    assert bench.dish.root_q == 0
    position = bench.state.position
    assert (position.az_deg, position.el_deg) == (pytest.approx(200.0, abs=0.6), pytest.approx(30.0, abs=0.6))
    assert bench.state.fault is None
    assert bench.state.held is None


@pytest.mark.parametrize("echo", ["off", "upper"])
def test_a_console_whose_echo_is_missing_is_told_so_and_not_called_dead(echo):
    bench = Bench(echo=echo)
    bench.until(lambda: bench.state.link.state is LinkPhase.SILENT)
    assert "half duplex swallows the echo" in bench.state.link.detail
    assert "deadlocked" not in bench.state.link.detail
    assert bench.dish.root_q == 0
