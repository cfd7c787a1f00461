"""`birdcage passes` lists what the mounted feed can hear, once one is set."""

from __future__ import annotations

import time
from datetime import UTC, datetime

import pytest
from birdcage.base.config import FeedProfile
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.downlinks_hearing import listener
from birdcage.sky.downlinks_read import shipped
from birdcage.sky.elements import ElementSet

NOW = datetime.now(UTC)
STATION = ElementSet("ISS (ZARYA)", 25544, NOW, 51.6, 0, 0.0005, 0, 0, 15.4995)
METOP = ElementSet("METOP-B", 38771, NOW, 98.7, 0, 0.0001, 0, 0, 14.215)
HELIX = '[feed]\nactive = "helix"\n[feed.helix]\nfreq_min_hz = 1.67e9\nfreq_max_hz = 1.71e9\n'


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    with Catalogue(Paths.in_folder(tmp_path).catalogue) as catalogue:
        catalogue.add([STATION, METOP])
    return tmp_path


@pytest.fixture
def listed(run, as_json):
    """Return which satellites are listed, and what was said."""

    def listed(*words):
        result = run("passes", "--lat", 52.0, "--lon", 5.0, "--json", *words, port=None, firmware="")
        return {each["name"] for each in as_json(result)}, result.stderr

    return listed


def test_without_a_feed_of_ones_own_all_are_listed(listed):
    assert listed()[0] == {"ISS (ZARYA)", "METOP-B"}


def test_with_one_only_what_it_hears_and_how_many_that_is(listed, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    names, said = listed()
    assert names == {"METOP-B"}
    assert "1 of 2 satellites are known to send what feed helix hears. --any lists all." in said
    assert listed("--any")[0] == {"ISS (ZARYA)", "METOP-B"}
    assert listed("--name", "iss")[0] == {"ISS (ZARYA)"}, "who asks by name gets it"
    assert listed("--name", "iss", "--hearable")[0] == set()


def test_the_filter_can_be_asked_for_with_the_stock_feed_which_hears_no_low_satellite(listed):
    names, said = listed("--hearable")
    assert names == set()
    assert "0 of 2 satellites" in said


def test_what_is_heard_of_it_stands_beside_each_pass(run, as_json, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    (at_home / "downlinks.toml").write_text(
        '[[downlink]]\nsatellite = "METOP-B"\nfreq_mhz = 1701.3\nmode = "AHRPT"\npolarization = "RHCP"\nalive = true\n'
        'symbol_rate_baud = 2333333\npipeline = "metop_ahrpt"\ndate = "2012"\n'
    )
    words = ("passes", "--lat", 52.0, "--lon", 5.0)
    told = run(*words, port=None, firmware="").stdout.splitlines()
    assert told[0].split()[-2:] == ["DOWNLINK", "SATDUMP"]
    assert told[1].split()[-4:] == ["1701.3", "AHRPT", "?", "metop_ahrpt"], "of 2012: doubtful"
    each = as_json(run(*words, "--json", port=None, firmware=""))[0]
    assert {name: value for name, value in each.items() if name.startswith("downlink_")} == {
        "downlink_hz": 1701.3e6, "downlink_mode": "AHRPT", "downlink_polarization": "RHCP",
        "downlink_symbol_rate_baud": 2333333, "downlink_pipeline": "metop_ahrpt", "downlink_date": "2012",
        "downlink_doubtful": True,
    }  # fmt: skip
    csv = run(*words, "--csv", "-", port=None, firmware="").stdout.splitlines()
    assert ",downlink_pipeline," in csv[0]
    assert ",metop_ahrpt," in csv[1]


def test_ones_own_table_counts(listed, at_home):
    (at_home / "birdcage.toml").write_text(HELIX)
    (at_home / "downlinks.toml").write_text('[[downlink]]\nsatellite = "ISS"\nnorad_id = 25544\nfreq_mhz = 1690\n')
    assert listed()[0] == {"ISS (ZARYA)", "METOP-B"}


def test_a_catalogue_of_ten_thousand_is_filtered_at_once():
    hears = listener(shipped(), FeedProfile(freq_min_hz=1e9, freq_max_hz=2e9))
    names = [(70000 + number, f"STARLINK-{number} (V{number})") for number in range(10_000)]
    begin = time.perf_counter()
    assert not any(hears(*each) for each in names)
    assert time.perf_counter() - begin < 2.0
