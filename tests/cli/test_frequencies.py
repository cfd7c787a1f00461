"""`birdcage if` and `birdcage downlinks`: where a frequency ends up, and what a feed can hear."""

from __future__ import annotations

import re

import pytest

HELIX = """
[feed]
active = "helix"
[feed.helix]
freq_min_hz = 1.67e9
freq_max_hz = 1.71e9
polarization = "circular"
lo_hz = 0.0
"""


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def ask(run):
    def ask(*words, **more):
        return run(*words, firmware="", **more)

    return ask


@pytest.fixture
def in_its_time(monkeypatch):
    """Keep what ships from growing doubtful: `on 2026-10-16` is not for ever."""
    monkeypatch.setattr("birdcage.sky.downlinks_age.DOUBTFUL_DAYS", 10**6)


def lines(result):
    return [" ".join(line.split()) for line in result.stdout.splitlines()]


def test_qo100_behind_a_universal_lnb(ask):
    result = ask("if", "--lo", "9750M", "--rf", "10489.5M")
    told = lines(result)
    assert "IF 739.5 MHz" in told
    assert "LO 9750 MHz, below the signal: not inverted" in told
    assert "QO-100 narrow band, vertical" in told
    assert "RTL-SDR (R820T, R828D) ✓ reaches it" in told
    missed = told.index("television receiver ✗ 950 to 2150 MHz: 210.5 MHz too low")
    assert told[missed + 1] == "an LO of 9539.5 MHz or less would do"
    made_for = told.index("as in a universal LNB, low band (no tone), for 10700 to 11700 MHz")
    assert told[made_for + 1] == "not made for this frequency: expect less, or nothing"
    assert max(len(line) for line in result.stdout.splitlines()) <= 80


def test_a_c_band_lnb_inverts(ask, as_json):
    assert "LO 5150 MHz, above the signal: the spectrum is inverted" in lines(
        ask("if", "--lo", "5150M", "--rf", "3.95G")
    )
    (found,) = as_json(ask("if", "--lo", "5150M", "--rf", "3.95G", "--json"))
    assert (found["if_hz"], found["inverted"], found["image_hz"]) == (1.2e9, True, 6.35e9)
    assert found["lnbs"] == ["C-band LNB"]
    assert {each["name"]: each["reaches"] for each in found["receivers"]}["SkyWalker-1"] is True


def test_the_other_way_round_names_both_that_it_may_have_been(ask, as_json):
    found = as_json(ask("if", "--lo", "9750M", "--if", "1G", "--json"))
    assert [each["rf_hz"] for each in found] == [10.75e9, 8.75e9]


def test_the_oscillator_is_the_feeds_unless_one_is_named(ask, at_home, as_json):
    (at_home / "birdcage.toml").write_text(HELIX.replace("lo_hz = 0.0", "lo_hz = 1.0e9"))
    result = ask("if", "--rf", "1701.3M", "--json")
    assert as_json(result)[0]["if_hz"] == 701.3e6
    assert "Feed helix: LO 1000 MHz." in result.stderr


@pytest.mark.usefixtures("in_its_time")
def test_a_sender_is_told_with_what_it_sends(ask, as_json):
    told = lines(ask("if", "--rf", "1701.3M", "--lo", "1M"))
    assert "METOP-B AHRPT, RHCP, 2.333 Mbaud SatDump metop_ahrpt on 2026-10-16" in told
    (found,) = as_json(ask("if", "--rf", "1701.3M", "--lo", "1M", "--json"))
    assert {each["pipeline"] for each in found["downlinks"]} == {"metop_ahrpt"}
    many = ask("if", "--rf", "12.5G", "--lo", "11.25G").stdout
    assert "AsiaSat 5" in many
    assert max(len(line) for line in many.splitlines()) <= 80


def test_who_is_dead_is_not_named_as_a_sender(ask, as_json):
    (found,) = as_json(ask("if", "--rf", "1701.3M", "--lo", "1M", "--json"))
    assert found["satellites"] == ["METOP-B", "METOP-C"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--rf", "1701300000"), "for hertz type 1701300000Hz"),
        ((), "Give --rf"),
        (("--rf", "1G", "--if", "1G"), "Give --rf"),
        (("--rf", "much"), "not a frequency"),
    ],
)
def test_what_cannot_be_worked_out_is_said(ask, words, told):
    result = ask("if", *words)
    assert result.exit_code == 2
    assert told in result.stderr


@pytest.mark.usefixtures("in_its_time")
def test_downlinks_of_the_mounted_feed_with_what_the_polarisation_costs(ask, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    told = lines(ask("downlinks"))
    assert told[0] == "SATELLITE MHZ MODE POL SYMBOLS SATDUMP ON THE AIR REMARK"
    assert "METOP-B 1701.3 AHRPT RHCP 2.333 Mbaud metop_ahrpt on 2026-10-16 -" in told
    lost = "3 dB lost: linear into a feed of the other kind"
    assert f"GOES 19 1694.1 HRIT linear 927 kbaud goes_hrit on 2026-10-16 {lost}" in told
    assert not [line for line in told if line.startswith(("NOAA 1", "QO-100"))]


def test_all_of_them_also_those_off_the_air_and_beside_the_band(ask, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    told = lines(ask("downlinks", "noaa 1", "--all"))
    assert "NOAA 18 1707 HRPT RHCP 665.4 kbaud noaa_hrpt off since 2025-06-06 -" in told
    assert "NOAA 15 137.62 APT RHCP - noaa_apt off since 2025-08-19 not in this feed's band" in told
    assert "hears nothing of it; --all" in ask("downlinks", "noaa 1").stderr


def test_what_nobody_has_confirmed_for_years_is_doubtful_in_the_table_and_in_json(ask, at_home, as_json):
    (at_home / "birdcage.toml").write_text(HELIX)
    row = '[[downlink]]\nsatellite = "{}"\nfreq_mhz = 1690\nalive = true\ndate = "{}"\n'
    (at_home / "downlinks.toml").write_text(row.format("OLD ONE", "2012") + row.format("NEW ONE", "2099"))
    told = lines(ask("downlinks", "one"))
    (old,) = (line for line in told if line.startswith("OLD ONE"))
    assert re.fullmatch(r"OLD ONE 1690 - - - - doubtful: 2012, \d\d y -", old)
    assert "NEW ONE 1690 - - - - on 2099 -" in told
    first, second = as_json(ask("downlinks", "one", "--json"))
    assert (first["doubtful"], second["doubtful"], second["age_days"]) == (True, False, 0)
    assert first["age_days"] > 13 * 365


def test_mode_symbol_rate_and_pipeline_are_in_json(ask, at_home, as_json):
    (at_home / "birdcage.toml").write_text(HELIX)
    (metop,) = (each for each in as_json(ask("downlinks", "metop-b", "--json")) if each["mode"] == "AHRPT")
    assert (metop["symbol_rate_baud"], metop["pipeline"], metop["pipeline_live"]) == (2333333, "metop_ahrpt", True)
    assert metop["polarization"] == "RHCP"


def test_the_stock_feed_is_circular_and_hears_no_linear_television_below_its_band(ask, as_json):
    told = lines(ask("downlinks"))
    assert any(re.match("EchoStar 16 12224-12676 .*circular", line) for line in told)
    assert not [line for line in told if line.startswith(("Galaxy", "QO-100"))]
    assert "12200 to 12700 MHz" in ask("downlinks", "galaxy").stderr
    result = ask("if", "--rf", "12224M")
    assert "Feed stock Ku LNB: LO 11250 MHz." in result.stderr
    assert "IF         974 MHz" in result.stdout
    assert "as in a DISH and Bell LNB, circular" in result.stdout


def test_a_feed_without_a_band_lists_all_and_says_why(ask, at_home, as_json):
    (at_home / "birdcage.toml").write_text('[feed]\nactive = "horn"\n[feed.horn]\nbeam_deg = 5.0\n')
    result = ask("downlinks", "--json")
    assert len(as_json(result)) > 100
    assert "has no freq_min_hz" in result.stderr
    assert not any(each["hearable"] for each in as_json(result))


def test_ones_own_file_counts_and_what_is_wrong_with_it_is_said(ask, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    (at_home / "downlinks.toml").write_text(
        '[[downlink]]\nsatellite = "MINE"\nfreq_mhz = 1690\n[[downlink]]\nsatellite = "YOURS"\n'
    )
    result = ask("downlinks")
    assert "MINE 1690 - - - - - -" in lines(result)
    assert "downlinks.toml:4: freq_mhz is missing" in result.stderr
