"""The sources that settings name: which there are, which one is heard, what another feed changes."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.config import load
from birdcage.ready.signal import signal
from birdcage.signal.ear import SourceEar, TunerEar
from birdcage.signal.source_set import SourceSet

from tests.radio.scripted import Server, sdr
from tests.radio.sdrpp import OneAtATime, SdrPlusPlus
from tests.signal.stand_ins import SatDump
from tests.station.conftest import Bench


def settings_of(tmp_path, text):
    file = tmp_path / "birdcage.toml"
    file.write_text(text)
    return load(file, environ={})


def made(settings, again=None):
    bench = Bench()
    sources = SourceSet(settings, bench.clock, None if again is None else lambda: again, threads=False)
    sources.attach(bench.station)
    return sources


MINE = '[feed]\nactive = "helix"\n[feed.helix]\nsignal = "meter"\n[signal.meter]\ncommand = "meter -x"\nunit = "V"\n'


def test_a_feed_names_a_program_of_its_owner(tmp_path):
    settings = settings_of(tmp_path, MINE)
    assert not settings.problems
    sources = made(settings)
    monitor = sources.monitor(lambda _reading: None)
    facts = monitor.chosen.facts
    assert (facts.id, facts.unit, facts.where, facts.of_dish) == ("meter", "V", "meter -x", False)
    assert sources.ids == ("tuner", "meter", "satdump", "gqrx", "sdrpp", "rtl_tcp", "rtl_power")
    assert isinstance(sources.ear(""), SourceEar)
    assert isinstance(sources.ear("tuner"), TunerEar)
    with pytest.raises(TypeError, match="there is no signal source called sdr"):
        sources.ear("sdr")


def test_a_table_of_a_presets_name_changes_it(tmp_path):
    settings = settings_of(tmp_path, '[signal.satdump]\nurl = "http://radio:9000/api"\n')
    profile = settings.signals["satdump"]
    assert (profile.kind, profile.url, profile.path) == ("http", "http://radio:9000/api", "*.snr")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[feed.helix]\nsignal = "satdmp"\n', "did you mean satdump?"),
        ("[signal.meter]\nunit = 'V'\n", "signal.meter.command is missing"),
        ('[signal.tuner]\nkind = "http"\n', "signal.tuner is a name that is taken"),
        ('[signal]\nurl = "http://x"\n', "signal.url is a value, where a section [signal.NAME] belongs"),
        ('[signal.x]\nkind = "rtl_tcp"\naddress = "a:1"\nchannel_hz = 2e6\n', "more than sample_rate_hz"),
        ('[signal.x]\nkind = "http"\nurl = "http://x"\n', "signal.x.path is missing"),
    ],
)
def test_what_is_wrong_with_a_source_is_said_and_the_dish_may_move(tmp_path, text, words):
    settings = settings_of(tmp_path, text)
    assert any(words in problem.sentence for problem in settings.problems), settings.problems
    assert settings.motion_problem is None


def test_one_that_is_chosen_by_hand_counts_until_another_feed_is_mounted(tmp_path):
    settings = settings_of(tmp_path, MINE)
    other = replace(settings, feeds={**settings.feeds, "helix": replace(settings.feeds["helix"], signal="gqrx")})
    sources = made(settings, other)
    monitor = sources.monitor(lambda _reading: None)
    sources.choose("satdump")
    monitor.choose("satdump")
    assert monitor.chosen.facts.label == "SatDump"
    assert sources.chosen == "satdump"
    assert sources.chosen_now() == "gqrx"
    monitor.choose("gqrx")
    assert monitor.chosen.facts.unit == "dBFS"


def checked(tmp_path, kind, **more):
    keys = "\n".join(f'{key} = "{value}"' for key, value in {"kind": kind, **more}.items())
    text = f'[feed]\nactive = "helix"\n[feed.helix]\nsignal = "mine"\n[signal.mine]\n{keys}\n'
    return list(signal(settings_of(tmp_path, text)))


def test_ready_reads_one_level_of_it(tmp_path):
    server = SatDump(snr=6.5)
    try:
        (check,) = checked(tmp_path, "http", url=server.url, path="*.snr")
    finally:
        server.close()
    assert (check.state, check.words) == ("good", "mine tells 6.5 dB")


def test_ready_says_of_sdrpp_that_it_has_no_level(tmp_path):
    radio = OneAtATime(SdrPlusPlus())
    try:
        (check,) = checked(tmp_path, "rigctl", address=radio.address)
    finally:
        radio.close()
    assert check.state == "look"
    assert "SDR++ advertises one and answers RPRT 1" in check.words


def test_ready_asks_nothing_where_the_dish_is_heard_by_itself(tmp_path):
    gqrx = Server(sdr())
    try:
        assert list(signal(settings_of(tmp_path, f'[signal.gqrx]\naddress = "{gqrx.address}"\n'))) == []
    finally:
        gqrx.close()
    assert gqrx.accepted == 0
