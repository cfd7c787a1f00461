"""The converter of the mounted feed: what the tuner behind it is set to, as a frequency in the sky."""

from __future__ import annotations

from birdcage.base.config.feeds import STOCK_FEED, FeedProfile
from birdcage.station.converter import FeedConverter, converter_of
from birdcage.station.state import StationState

from .conftest import Bench


def test_below_the_band_the_frequencies_add_up_and_above_it_they_are_taken_off():
    stock = converter_of(STOCK_FEED)
    assert stock is not None
    assert stock.rf_hz(1178.12e6) == 12_428.12e6
    above = converter_of(FeedProfile(freq_min_hz=2.2e9, freq_max_hz=2.3e9, lo_hz=3.65e9))
    assert above == FeedConverter(3.65e9, high_side=True)
    assert above.rf_hz(1.4e9) == 2.25e9


def test_without_an_lo_there_is_none():
    assert converter_of(FeedProfile(freq_min_hz=1.6e9, freq_max_hz=1.8e9)) is None


def test_the_state_has_that_of_the_mounted_feed():
    bench = Bench(options={"feed": STOCK_FEED}).connect()
    assert bench.state.converter == FeedConverter(11.25e9)
    assert StationState.__dataclass_fields__["converter"].default is None
