"""Intermediate frequencies: which way round, what else lands there, and who tunes to it."""

from __future__ import annotations

import pytest
from birdcage.sky.band import Conversion, lnbs, megahertz, parse_frequency, plans, receivers, rf_of


@pytest.mark.parametrize(
    ("text", "hz"),
    [
        ("9750M", 9.75e9),
        ("10.4895 GHz", 10.4895e9),
        ("10489,5m", 10.4895e9),
        ("437800k", 437.8e6),
        ("1701300000Hz", 1.7013e9),
        ("1.7013e9 Hz", 1.7013e9),
        ("137.1", 137.1e6),
        ("10489,5", 10.4895e9),
        ("50 Hz", 50.0),
        (".5G", 5e8),
    ],
)
def test_units_are_hz_k_m_and_g_and_a_bare_number_is_in_mhz(text, hz):
    assert parse_frequency(text) == pytest.approx(hz)


@pytest.mark.parametrize("text", ["1701300000", "", "M", "-5M", "5 miles", "0M", "2000G", "nan", "1e9", "5,5,5M"])
def test_what_is_no_frequency_is_refused(text):
    with pytest.raises(ValueError, match=r"not a frequency|not between 1 Hz and 1 THz"):
        parse_frequency(text)


def test_a_number_of_hertz_without_its_unit_is_told_how_to_say_so():
    with pytest.raises(ValueError, match=r"A bare number is in MHz: for hertz type 137100000Hz\."):
        parse_frequency("137100000")


def test_an_oscillator_below_the_signal_keeps_the_spectrum_and_one_above_inverts_it():
    low = Conversion(10489.5e6, 9750e6)
    assert (low.if_hz, low.inverted, low.image_hz) == (739.5e6, False, 9010.5e6)
    high = Conversion(3950e6, 5150e6)
    assert (high.if_hz, high.inverted, high.image_hz) == (1200e6, True, 6350e6)


def test_without_a_converter_the_receiver_is_tuned_to_the_signal():
    assert Conversion(1701.3e6, 0.0).if_hz == 1701.3e6
    assert Conversion(1701.3e6, 0.0).image_hz is None
    assert [each.rf_hz for each in rf_of(0.0, 1701.3e6)] == [1701.3e6]


def test_what_was_received_lies_above_or_below_the_oscillator():
    assert [each.rf_hz for each in rf_of(5150e6, 1200e6)] == [6350e6, 3950e6]
    assert [each.rf_hz for each in rf_of(100e6, 1200e6)] == [1300e6], "nothing lies below zero"
    assert all(each.if_hz == 1200e6 for each in rf_of(5150e6, 1200e6))


def test_qo100_behind_a_universal_lnb_is_below_what_the_skywalker_tunes():
    reach = {each.name: each.beside_hz(Conversion(10491.5e6, 9750e6).if_hz) for each in receivers()}
    assert reach["SkyWalker-1"] == pytest.approx(741.5e6 - 950e6)
    assert reach["RTL-SDR (R820T, R828D)"] == 0.0


def test_every_row_has_a_source_and_a_range_and_every_lnb_an_oscillator_outside_its_band():
    for each in (*lnbs(), *receivers(), *plans()):
        assert each.source
        assert each.low_hz < each.high_hz
    for each in lnbs():
        assert each.lo_hz is not None
        assert not each.holds(each.lo_hz)
        ends = sorted(Conversion(hz, each.lo_hz).if_hz for hz in (each.low_hz, each.high_hz))
        assert ends[0] >= 949e6, "what comes out of an LNB is for a receiver from 950 MHz on"
        assert ends[1] <= 2151e6


def test_frequencies_are_shown_to_the_hertz_without_empty_digits():
    assert megahertz(10489.5e6) == "10489.5 MHz"
    assert megahertz(437.8e6) == "437.8 MHz"
    assert megahertz(1e9 + 1) == "1000.000001 MHz"
