"""Leapfrog applies to streams of targets only: less than 3 s apart, one holder. All else is exact."""

from __future__ import annotations

import pytest
from birdcage.station.requests import AcquireLease, Follow, Goto


def sent_azimuths(bench):
    return [float(line.split()[2]) for line in bench.lines() if line.startswith("a 0 ")]


@pytest.fixture
def followed(bench):
    bench.do(Goto(180, 45, "you"))

    def follow(az_deg, holder="tracker", leapfrog=True, wait=1.0):
        bench.station.submit(Follow(az_deg, 45.0, holder, leapfrog=leapfrog))
        bench.step(wait)
        return sent_azimuths(bench)[-1]

    return follow


def test_the_first_target_is_exact_and_the_next_ones_lead(bench, followed):
    bench.do(AcquireLease("tracker", take_over=True))
    assert followed(183) == 183.0
    assert followed(186) == 187.0
    assert followed(187.4) == pytest.approx(187.4, abs=0.51)


def test_after_a_pause_of_3_seconds_it_is_exact_again(bench, followed):
    bench.do(AcquireLease("tracker", take_over=True))
    followed(183)
    assert followed(186, wait=3.5) == 187.0
    assert followed(190) == 190.0


def test_exact_unless_asked(bench, followed):
    assert followed(183, holder="you", leapfrog=False) == 183.0
    assert followed(186, holder="you", leapfrog=False) == 186.0


def test_another_holder_begins_exactly(bench, followed):
    bench.do(AcquireLease("tracker", take_over=True))
    followed(183)
    bench.do(AcquireLease("scan", take_over=True))
    assert followed(186, holder="scan") == 186.0


def test_a_goto_is_exact_in_the_middle_of_a_stream(bench, followed):
    followed(183, holder="you")
    followed(186, holder="you")
    bench.do(Goto(190, 45, "you"))
    assert sent_azimuths(bench)[-1] == 190.0
