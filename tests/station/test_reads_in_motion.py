"""A dish that moves as it was sent is asked about once for each reading, as at rest."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Follow, Goto

from .conftest import Bench

MOST = 1.1
"""Exchanges a reading, on average."""
ADDRESSES = (
    "g2?seed=1", "g2?seed=3", "g2?seed=1&latency_min=0.02&latency_max=0.1", "hal205?seed=1",
    "hal205?seed=1&latency_min=0.02&latency_max=0.1",
)  # fmt: skip


class Counted:
    """A bench that counts readings of the position, and the lines that they cost."""

    def __init__(self, address):
        self.bench = Bench(address, firmware=address.partition("?")[0]).connect()
        self.bench.do(Goto(100.0, 40.0, "you"))
        self.bench.step(3.0)
        self.reads, self._since = 0, self.bench.clock.monotonic()
        belief = self.bench.station._antenna._readings.belief
        read = belief.read

        def counting(once, clock):
            self.reads += 1
            return read(once, clock)

        belief.read = counting

    @property
    def asked(self):
        return sum(line == "a" and at > self._since for at, line in self.bench.received())


@pytest.fixture(params=ADDRESSES)
def counted(request):
    return Counted(request.param)


@pytest.mark.parametrize("rate_deg_s", [1.0, 0.2])
def test_followed_at_5_hz(counted, rate_deg_s):
    for n in range(150):
        way = 0.2 * n * rate_deg_s
        counted.bench.station.submit(Follow(100.0 + way, 40.0 + 0.2 * way, "you"))
        counted.bench.step(0.2)
    assert counted.reads >= 140
    assert counted.asked / counted.reads <= MOST


def test_sent_far(counted):
    for az_deg, el_deg in ((230.0, 55.0), (80.0, 30.0), (250.5, 44.3), (10.0, 60.0)):
        counted.bench.do(Goto(az_deg, el_deg, "you"), seconds=60.0)
    assert counted.reads >= 20
    assert counted.asked / counted.reads <= MOST


def test_a_dish_that_goes_slower_than_expected_is_still_read():
    counted = Counted("g2?seed=1&az_speed=10")
    counted.bench.station._antenna.use_speeds({})
    counted.bench.do(Goto(230.0, 40.0, "you"), seconds=60.0)
    assert counted.bench.state.position.az_deg == pytest.approx(230.0, abs=0.1)
    assert counted.asked / counted.reads <= 1.2
