"""Random bytes from the dish's side: the station outlives them, moves nothing by them, and finds its feet again."""

from __future__ import annotations

import random

import pytest
from birdcage.station.requests import AcknowledgeFault, Goto, Release, Watch
from birdcage.station.state import Activity, LinkPhase

from tests.shared.night import by_night

from .bench import Bench

PIECES = (
    b"Angle[0] = ", b"Angle = ", b"180.00", b"\r\n", b"\r", b"\n", b"MOT", b"a 0 12", b"q", b"\x1b[", b"\xff\x00",
    b"2147483647", b"Bootloader", b"-1e9", b"NaN", b"  ", b"\x1b[2K", b"Unknown command", b"wrap_min:",
)  # fmt: skip
"""What a console prints, broken: never a whole prompt, which would be a dish that stands elsewhere."""


def _noise(rng: random.Random, size: int) -> bytes:
    if rng.random() < 0.5:
        return rng.randbytes(size).replace(b">", b"?")
    data = b""
    while len(data) < size:
        data += rng.choice(PIECES) if rng.random() < 0.7 else rng.randbytes(3).replace(b">", b"?")
    return data


def _storm(seed: int, count: int) -> Bench:
    """Send that many bytes of noise, at rest, in motion and in the midst of STOP, and let it become quiet."""
    rng = random.Random(seed)
    bench = Bench(seed=seed, az_speed=15.0, el_speed=10.0).connect()
    bench.station.submit(Watch("person", frozenset({"position", "rssi"}), 4.0))
    sent = 0
    while sent < count:
        deed = rng.random()
        if deed < 0.3:
            bench.station.submit(Goto(rng.uniform(0.0, 359.0), rng.uniform(20.0, 64.0), "you"))
        elif deed < 0.4:
            bench.station.stop("you")
        elif deed < 0.5:
            for request in (AcknowledgeFault("you"), Release("you")):
                bench.do(request, 30.0)
        for _ in range(rng.randint(1, 8)):
            data = _noise(rng, rng.choice((1, 3, 20, 200, 1500)))
            bench.dish.blurt(data)
            sent += len(data)
            bench.step(rng.uniform(0.0, 1.0))
        bench.step(rng.choice((0.0, 5.0, 20.0)))
    bench.step(60.0)
    return bench


def _judge(bench: Bench) -> None:
    dish, state = bench.dish, bench.state
    assert dish.root_q == 0
    assert dish.alive
    low, high = dish.span(1)
    assert low > 17.9
    assert high < 65.1
    assert all(0.0 <= each.deg <= 360.0 if each.axis == 0 else 18.0 <= each.deg <= 65.0 for each in dish.asked())
    assert state.link.state is LinkPhase.UP, state.link
    assert not dish.moves()
    assert state.activity is Activity.IDLE
    az, el = dish.where()
    assert (state.position.az_deg, state.position.el_deg) == (pytest.approx(az, abs=0.05), pytest.approx(el, abs=0.05))
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    told = bench.do(Goto(123.0, 45.0, "you"))
    bench.step(3.0)
    assert dish.where() == (pytest.approx(123.0, abs=0.05), pytest.approx(45.0, abs=0.05)), told


@pytest.mark.parametrize("seed", range(3))
def test_thousands_of_random_bytes(seed):
    _judge(_storm(seed, 5000))


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night(range(100, 125), 3))
def test_a_million_random_bytes(seed):
    _judge(_storm(seed, 40_000))
