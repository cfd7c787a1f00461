"""The shift of a downlink, against what people tune to."""

from __future__ import annotations

import pytest
from birdcage.sky.doppler import doppler_hz


@pytest.mark.parametrize(
    ("sent_hz", "away_km_s", "heard_hz"),
    [
        # The channels that amateurs store for SO-50 (700 km high, so it comes at up to 6.6 km/s), in steps of 5 kHz:
        # 436.805 MHz after its rise, 436.795 at its highest, 436.785 before it sets.
        (436.795e6, -6.6, 436.805e6),
        (436.795e6, 0.0, 436.795e6),
        (436.795e6, 6.6, 436.785e6),
    ],
)
def test_the_channels_of_so_50(sent_hz, away_km_s, heard_hz):
    assert sent_hz + doppler_hz(sent_hz, away_km_s) == pytest.approx(heard_hz, abs=2500.0)


def test_first_order_is_close_enough():
    exact_hz = 10e9 * (1.0 / (1.0 + 7.5 / 299_792.458) - 1.0)
    assert doppler_hz(10e9, 7.5) == pytest.approx(exact_hz, abs=7.0)
