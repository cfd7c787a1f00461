"""A dish that counts its azimuth on beyond the circle: what is told is a direction, 0 to 360."""

from __future__ import annotations

import pytest
from birdcage.station.report import status_report
from birdcage.station.requests import Stop

from .conftest import Bench

CASES = [
    ("g2?seed=1&az_print=cable&az=-90", "g2", 115200, 270.0),
    ("g2?seed=1&az_print=cable&az=12", "g2", 115200, 12.0),
    ("hal205?seed=1&az_print=cable&az=372&search_finds=0", "hal205", 57600, 12.0),
]  # fmt: skip


@pytest.mark.parametrize(("address", "firmware", "baud", "az_deg"), CASES)
def test_stop_status_and_farewell_tell_the_direction(address, firmware, baud, az_deg):
    bench = Bench(address, {"baud": baud}, firmware=firmware).connect()
    bench.do(Stop("test"))
    bench.step(10.0)
    report = bench.state.last_stop
    assert f"Stands still at {az_deg:.2f}°/" in report.sentence
    assert status_report(bench.state, bench.clock.monotonic())["azimuth_deg"] == az_deg
    assert bench.state.position.dish_az_deg % 360.0 == az_deg, "as the dish counts it"
    assert f"AZ {az_deg:.2f}°" in bench.session.close()
