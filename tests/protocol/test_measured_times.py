"""How long a Trav'ler takes, against the measured table (`docs/reference/travler.md`, *Times*)."""

from __future__ import annotations

import pytest
from birdcage.rotator.axis import MeasuredTimes

TRAVLER = MeasuredTimes(((0.5, 0.3), (1.0, 0.5)), from_deg=2.0, scale_s=3.23, per_deg=0.84, less_s=0.48)


@pytest.mark.parametrize(
    ("way_deg", "seconds"),
    [(0.3, 0.3), (0.7, 0.5), (2, 1.2), (3, 2.5), (5, 4.2), (10, 6.4), (20, 8.6), (45, 11.3), (90, 13.5), (180, 15.7),
     (270, 17.0), (360, 18.0)],
)  # fmt: skip
def test_the_measured_table(way_deg, seconds):
    assert TRAVLER.seconds(way_deg) == pytest.approx(seconds, abs=0.06)
    assert TRAVLER.seconds(-way_deg) == TRAVLER.seconds(way_deg)


def test_a_longer_way_never_takes_less_time():
    times = [TRAVLER.seconds(hundredths / 100) for hundredths in range(40000)]
    assert times == sorted(times)
    assert times[0] == 0.0
