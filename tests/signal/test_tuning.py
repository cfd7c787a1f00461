"""An RTL-SDR tuned by a person: in the connection under way, kept in the settings, refused with the range."""

from __future__ import annotations

import threading

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.config.edit import edit
from birdcage.base.errors import ConfigError
from birdcage.signal.rtl_tcp_meter import RtlTcpMeter, Tuned
from birdcage.signal.source_set import SourceSet
from birdcage.signal.tuning import checked_tuning

from tests.signal.stand_ins import RtlTcp
from tests.station.conftest import Bench

CLOCK = RealClock()
BEFORE = Tuned(1_420.4e6, 1.024e6, 200e3, 28.0)
AFTER = Tuned(1_694.1e6, 2.4e6, 100e3, None)


def wait_until(true, within_s=20.0):
    end = CLOCK.monotonic() + within_s
    while not true():
        assert CLOCK.monotonic() < end, "it did not come about"
        threading.Event().wait(0.02)


def test_a_running_receiver_is_retuned_without_hanging_up():
    receiver = RtlTcp(AFTER.freq_hz, carrier_db=-10.0)
    meter = RtlTcpMeter(receiver.address, BEFORE, CLOCK)
    try:
        meter.open()
        before = next(filter(None, (meter.read(0.2) for _ in range(100))))
        del receiver.commands[:]
        meter.retune(AFTER)
        assert meter.tuned == AFTER
        after = next(filter(None, (meter.read(0.2) for _ in range(100))))
    finally:
        meter.close()
        receiver.close()
    assert receiver.accepted == 1
    assert receiver.commands == [(2, 2_400_000), (1, round(AFTER.centre_hz)), (8, 0), (3, 0)]
    assert sum(before.spectrum.channel_hz) / 2.0 == pytest.approx(BEFORE.freq_hz)
    assert sum(after.spectrum.channel_hz) / 2.0 == pytest.approx(AFTER.freq_hz)
    assert after.value == pytest.approx(-10.0, abs=0.5), "nothing of before is in it"


@pytest.mark.parametrize("freq", ["", "freq_hz = 1420.4e6\n"], ids=["unset", "set"])
def test_it_counts_at_once_and_is_kept(tmp_path, freq):
    receiver, file = RtlTcp(AFTER.freq_hz, carrier_db=-10.0), tmp_path / "birdcage.toml"
    horn = '[feed]\nactive = "horn"\n[feed.horn]\nsignal = "rtl_tcp"\n'
    file.write_text(f'# mine\n{horn}[signal.rtl_tcp]\naddress = "{receiver.address}"\n{freq}')
    bench, told = Bench(), []

    def read():
        return load(file, environ={})

    sources = SourceSet(read(), CLOCK, read, keep=lambda changes: edit(file, changes))
    sources.attach(bench.station)
    source = sources.get("rtl_tcp")
    source.subscribe(told.append)
    source.watch("test")
    try:
        wait_until(lambda: told if freq else source.trouble)
        assert sources.tuned("rtl_tcp").freq_hz == (1_420.4e6 if freq else 0.0)
        assert sources.tune("rtl_tcp", AFTER)
        assert sources.tuned("rtl_tcp").freq_hz == AFTER.freq_hz
        wait_until(lambda: told and sum(told[-1].spectrum.channel_hz) / 2.0 == pytest.approx(AFTER.freq_hz))
        profile = read().signals["rtl_tcp"]
        assert (profile.freq_hz, profile.sample_rate_hz, profile.channel_hz, profile.gain_db) == (
            1_694.1e6, 2.4e6, 100e3, -1.0,
        )  # fmt: skip
        assert file.read_text().startswith("# mine\n")
        sources.chosen_now()
        assert sources.get("rtl_tcp") is source, "what is read again is what was set: nothing begins anew"
    finally:
        sources.close()
        receiver.close()


def test_what_can_not_be_kept_is_not_tuned():
    def refuses(_changes):
        raise ConfigError("The file is damaged.")

    bench = Bench()
    sources = SourceSet(load(None, environ={}), CLOCK, keep=refuses)
    sources.attach(bench.station)
    before = sources.tuned("rtl_tcp")
    with pytest.raises(ConfigError, match="damaged"):
        sources.tune("rtl_tcp", AFTER)
    assert sources.tuned("rtl_tcp") == before
    assert sources.tuned("satdump") is None
    assert sources.tuned("tuner") is None


@pytest.mark.parametrize(("tuned", "words"), [
    ((100e3, 1.024e6, 200e3, 28.0), r"Frequency 0\.1 MHz is out of range\. Type 0\.5 to 2200"),
    ((3e9, 1.024e6, 200e3, 28.0), "Frequency 3000 MHz"),
    ((float("nan"), 1.024e6, 200e3, 28.0), "Frequency nan MHz"),
    ((1e9, 600e3, 200e3, 28.0), "Sample rate 600 kHz is out of range. Type 226 to 300, or 901 to 2400"),
    ((1e9, 3.2e6, 200e3, 28.0), "Sample rate 3200 kHz"),
    ((1e9, 1e6, 1.2e6, 28.0), "Channel 1200 kHz is out of range. Type 1 to 1000, the sample rate"),
    ((1e9, 1e6, 200e3, 61.0), "Gain 61 dB is out of range. Type 0 to 60, or auto"),
    ((1e9, 1e6, 200e3, -3.0), "Gain -3 dB"),
])  # fmt: skip
def test_what_a_receiver_does_not_take_is_refused_with_its_range(tuned, words):
    with pytest.raises(ValueError, match=words):
        checked_tuning(*tuned)
