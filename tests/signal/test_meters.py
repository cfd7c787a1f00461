"""Each kind of source against a stand-in of the program that it reads: what is heard, and what is said else."""

from __future__ import annotations

import contextlib
import math
import re

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.config.signals import PRESETS, SignalProfile
from birdcage.signal.http_meter import HttpMeter, number_at
from birdcage.signal.meter import MeterError
from birdcage.signal.meter_source import MeterSource
from birdcage.signal.metered import metered_source
from birdcage.signal.rigctl_meter import RigctlMeter
from birdcage.signal.rtl_tcp_meter import BINS, RtlTcpMeter, Tuned, block_spectra, level_of
from birdcage.signal.source import MONITOR

from tests.radio.scripted import Server, sdr
from tests.radio.sdrpp import OneAtATime, SdrPlusPlus
from tests.signal.reading import end_of, level, opened, wait_until
from tests.signal.stand_ins import RtlTcp, SatDump, program
from tests.station.conftest import Bench

CLOCK = RealClock()
CHANNEL = Tuned(1_420_400_000.0, 1_024_000.0, 200_000.0, 28.0)


@contextlib.contextmanager
def served(server):
    try:
        yield server
    finally:
        server.close()


# rtl_tcp


@pytest.mark.parametrize("mood", ["", "odd"])
def test_a_carrier_ten_decibels_over_the_noise_is_measured_within_a_third_of_one(mood):
    # The carrier stands in the channel, with the part of the noise that falls into it: 200 of 1,024 kHz.
    with served(RtlTcp(CHANNEL.freq_hz + 20_000.0, carrier_db=-27.1, noise_db=-30.0, mood=mood)) as receiver:
        with opened(RtlTcpMeter(receiver.address, CHANNEL, CLOCK)) as meter:
            carrier = level(meter).value
        receiver.carrier_db = -200.0
        with opened(RtlTcpMeter(receiver.address, CHANNEL, CLOCK)) as meter:
            noise = level(meter).value
    in_channel = 0.1 * 10**-3 * 200.0 / 1024.0 * 10.0
    assert noise == pytest.approx(-30.0 + 10 * 0.1 * -7.09, abs=0.4), in_channel
    # 10 dB over that noise is -27.1; both add up to 10.41 dB over it.
    assert carrier - noise == pytest.approx(10.41, abs=0.3)


def test_it_is_tuned_from_here_beside_the_channel_and_by_hand():
    with served(RtlTcp(CHANNEL.freq_hz)) as receiver:
        with opened(RtlTcpMeter(receiver.address, CHANNEL, CLOCK)) as meter:
            told = level(meter)
        commands = dict(receiver.commands)
    assert commands == {2: 1_024_000, 1: round(CHANNEL.centre_hz), 8: 0, 3: 1, 4: 280}
    assert CHANNEL.freq_hz - CHANNEL.centre_hz > CHANNEL.channel_hz / 2.0
    spectrum = told.spectrum
    step_hz = (spectrum.high_hz - spectrum.low_hz) / len(spectrum.levels)
    peak_hz = spectrum.low_hz + (spectrum.levels.index(max(spectrum.levels)) + 0.5) * step_hz
    assert spectrum.channel_hz == (CHANNEL.freq_hz - 100e3, CHANNEL.freq_hz + 100e3)
    assert peak_hz == pytest.approx(CHANNEL.freq_hz, abs=1.01 * step_hz)
    assert told.dwell_s == pytest.approx(0.1, abs=0.01)


def test_a_carrier_outside_of_the_channel_is_not_in_its_level():
    receiver = RtlTcp(CHANNEL.freq_hz + 150_000.0, carrier_db=-10.0)
    with served(receiver), opened(RtlTcpMeter(receiver.address, CHANNEL, CLOCK)) as meter:
        assert level(meter).value < -35.0


def test_the_power_of_a_full_tone_is_one():
    import numpy as np

    at = np.arange(64 * BINS)
    tone = np.exp(2j * np.pi * 0.1 * at)
    pairs = np.column_stack((tone.real, tone.imag)).ravel()
    samples = np.round(pairs * 127.0 + 127.4).clip(0, 255).astype(np.uint8).tobytes()
    wide = Tuned(0.0, 1.0e6, 1.0e6, None)
    level_db, scatter_db = level_of(block_spectra(samples), wide)
    assert level_db == pytest.approx(20.0 * math.log10(127.0 / 128.0), abs=0.04)
    assert scatter_db < 0.01


def test_of_noise_a_reading_says_how_much_one_of_its_blocks_scatters():
    receiver = RtlTcp(CHANNEL.freq_hz, carrier_db=-200.0)
    with served(receiver), opened(RtlTcpMeter(receiver.address, CHANNEL, CLOCK)) as meter:
        told = level(meter)
    assert told.n == 100
    # 200 steps of 1 kHz. Behind a Hann window neighbours share 4/9 of their variance, and the next ones 1/36.
    part = math.sqrt((1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0)) / 200.0)
    assert told.scatter == pytest.approx(10.0 / math.log(10.0) * part, abs=0.1)


def test_one_block_alone_has_no_scatter():
    assert level_of(block_spectra(bytes(2 * BINS)), Tuned(0.0, 1.0e6, 1.0e6, None))[1] is None


@pytest.mark.parametrize(
    ("receiver", "words"),
    [
        ({"header": b"HTTP/1.1 400"}, "is not rtl_tcp"),
        ({"header": b"", "mood": "silent"}, "Does another program have the receiver?"),
        ({"mood": "short"}, "closed the connection"),
    ],
)
def test_what_is_no_rtl_tcp_or_leaves_says_so(receiver, words):
    with served(RtlTcp(CHANNEL.freq_hz, **receiver)) as there:
        meter = RtlTcpMeter(there.address, CHANNEL, CLOCK)
        assert re.search(words, end_of(meter))


def test_where_nothing_listens_it_says_what_to_start():
    with pytest.raises(MeterError, match="Start it"):
        RtlTcpMeter("127.0.0.1:1", CHANNEL, CLOCK).open()


# HTTP


def test_satdumps_snr_is_read_whatever_the_stage_is_called():
    with served(SatDump()) as server, opened(HttpMeter(server.url, "*.snr", CLOCK, every_s=0.05)) as meter:
        before = CLOCK.monotonic()
        told = level(meter)
        assert (told.value, server.asked[0]) == (7.25, "/api")
        assert before <= told.at <= CLOCK.monotonic()
        server.snr = 3.5
        assert level(meter).value == 3.5


@pytest.mark.parametrize(
    ("server", "words"),
    [
        ({"body": b"<html>"}, "no JSON"),
        ({"body": b'{"other": 1}'}, r"no number at \*\.snr"),
        ({"body": b'{"a": {"snr": "high"}}'}, "no number"),
        ({"body": b'{"a": {"snr": NaN}}'}, "no number"),
        ({"body": b'{"a": {"snr": 1e300}}'}, "no number"),
        ({"body": b'{"a": {"snr": ' + b"9" * 400 + b"}}"}, "no number"),
        ({"status": 503}, "status 503"),
        ({"body": b"\xff\x1b[2J"}, "no JSON"),
    ],
)
def test_what_is_no_number_in_json_says_so(server, words):
    with served(SatDump(**server)) as there, opened(HttpMeter(there.url, "*.snr", CLOCK, every_s=0.05)) as meter:
        with pytest.raises(MeterError, match=words) as failed:
            level(meter)
        assert str(failed.value).isprintable()


def test_where_no_server_is_it_says_what_to_start():
    said = end_of(HttpMeter("http://127.0.0.1:1/api", "*.snr", CLOCK, every_s=0.05))
    assert said == "Nothing answers at http://127.0.0.1:1/api. Start the program that serves it."


def test_a_path_leads_through_names_lists_and_anything():
    data = {"stages": [{"snr": True}, {"snr": 4}], "x": {"y": 2.5}}
    assert number_at(data, ["x", "y"]) == 2.5
    assert number_at(data, ["stages", "1", "snr"]) == 4.0
    assert number_at(data, ["stages", "*", "snr"]) == 4.0
    assert number_at(data, ["stages", "7", "snr"]) is None


# rigctl


def test_gqrx_is_only_listened_to():
    with served(Server(sdr(strength="-38.5"))) as gqrx:
        with opened(RigctlMeter(gqrx.address, CLOCK, every_s=0.05)) as meter:
            assert level(meter).value == -38.5
        assert set(gqrx.heard) == {"l STRENGTH"}


def test_sdrpp_has_no_level_and_it_is_said():
    with served(OneAtATime(SdrPlusPlus())) as radio:
        assert end_of(RigctlMeter(radio.address, CLOCK, every_s=0.05)).startswith("No level: SDR++ advertises one")


# As a source


def metered(profile, name="mine"):
    bench = Bench()
    source = metered_source(name, Settings(signals={name: profile}), CLOCK, bench.station)
    heard = []
    source.subscribe(heard.append)
    return source, heard, bench.station


def test_it_is_read_only_while_somebody_watches_and_shows_who():
    text = "import time\nwhile True:\n print(5)\n time.sleep(0.02)"
    source, heard, station = metered(SignalProfile("command", command=program(text), unit="V", scale="linear"))
    assert not heard
    source.watch(MONITOR)
    wait_until(lambda: len(heard) > 2)
    assert (heard[0].value, heard[0].unit, heard[0].source) == (5.0, "V", "mine")
    assert station.state.signal_owners == {"mine": MONITOR}
    source.unwatch(MONITOR)
    wait_until(lambda: source._thread is None)
    assert "mine" not in station.state.signal_owners


def test_a_program_that_dies_is_started_again_and_its_words_are_shown_meanwhile():
    source, heard, _station = metered(SignalProfile("command", command=program("print(5)\nraise SystemExit(2)")))
    source.watch(MONITOR)
    try:
        wait_until(lambda: "exit status 2" in source.trouble)
        wait_until(lambda: len(heard) > 1)
    finally:
        source.close()


def test_one_that_falls_silent_is_said_to_and_tried_again():
    profile = SignalProfile("command", command=program("import time\nprint(5)\ntime.sleep(60)"), every_s=0.1)
    source, heard, _station = metered(profile)
    source.watch(MONITOR)
    try:
        wait_until(lambda: "has told nothing for" in source.trouble)
        wait_until(lambda: len(heard) > 1)
    finally:
        source.close()


def test_rtl_tcp_without_a_frequency_says_what_to_set():
    settings = Settings()
    feed = {"bare": type(settings.active_feed)()}
    bare = Settings(feed=type(settings.feed)("bare"), feeds=feed)
    source = metered_source("rtl_tcp", bare, CLOCK, Bench().station)
    source.watch(MONITOR)
    try:
        wait_until(lambda: "signal.rtl_tcp.freq_hz is not set" in source.trouble)
    finally:
        source.close()


def test_presets_are_complete_and_rtl_power_gets_the_channel_of_the_feed():
    assert set(PRESETS) == {"satdump", "gqrx", "sdrpp", "rtl_tcp", "rtl_power"}
    for name, profile in PRESETS.items():
        assert not list(profile.complaints()), name
        assert isinstance(metered_source(name, Settings(), CLOCK, Bench().station), MeterSource)
    meter = metered_source("rtl_power", Settings(), CLOCK, Bench().station).meter
    assert meter._command == "rtl_power -f 1199900000:1200100000:200000 -i 1 -"
