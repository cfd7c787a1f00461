"""Who sends what: the table that ships, the user's own over it, and what a feed can hear of it."""

from __future__ import annotations

import tomllib
from datetime import UTC, datetime
from importlib.resources import files

import pytest
from birdcage.base.config import FeedProfile
from birdcage.base.config.feeds import STOCK_FEED
from birdcage.sky.downlinks import plain
from birdcage.sky.downlinks_age import age_days, is_doubtful
from birdcage.sky.downlinks_hearing import has_band, hearable, hearing
from birdcage.sky.downlinks_read import load_downlinks, shipped
from birdcage.sky.downlinks_words import air_words
from birdcage.sky.slots import slots

HELIX = FeedProfile(freq_min_hz=1.67e9, freq_max_hz=1.71e9, polarization="circular")


@pytest.fixture
def own(tmp_path):
    """Load the table with a text of the user's over it."""

    def own(text):
        path = tmp_path / "downlinks.toml"
        path.write_text(text, encoding="utf-8")
        return load_downlinks(path)

    return own


def only(found):
    (each,) = found
    return each


def test_what_ships_is_some_sixty_satellites_or_more_each_with_source_and_date():
    assert len({plain(each.satellite) for each in shipped()}) >= 60
    assert all(each.source and each.date and each.mode for each in shipped())
    assert all(1e6 < each.freq_min_hz <= each.freq_max_hz < 1e11 for each in shipped())


@pytest.mark.parametrize(("number", "day"), [(25338, "2025-08-19"), (28654, "2025-06-06"), (33591, "2025-08-13")])
def test_the_old_noaa_satellites_are_off_the_air(number, day):
    found = load_downlinks().of(number, "")
    assert {each.mode for each in found} == {"APT", "HRPT"}
    assert all(each.alive is False and each.silent_since == day for each in found)


def test_since_when_something_is_silent_goes_with_its_being_off_the_air(own):
    row = '[[downlink]]\nsatellite = "X"\nfreq_mhz = 1\n{}\n'
    assert own(row.format('alive = false\nsilent_since = "2024-05"')).entries[0].silent_since == "2024-05"
    for wrong, words in (
        ('alive = true\nsilent_since = "2024"', "silent_since goes with alive = false"),
        ('alive = false\nsilent_since = "May"', "silent_since is 'May', not a date"),
    ):
        assert words in only(own(row.format(wrong)).problems)


def test_what_stands_in_the_table_of_slots_takes_its_place_from_there_and_is_told_once():
    at = {plain(name): slot.longitude_deg for slot in slots() for name in (slot.name, *slot.aliases)}
    text = (files("birdcage.sky") / "data" / "downlinks.toml").read_text(encoding="utf-8")
    rows = tomllib.loads(text)["downlink"]
    here = [row for row in rows if any(plain(name) in at for name in (row["satellite"], *row.get("names", ())))]
    assert len(here) > 50
    assert [row["satellite"] for row in here if "longitude_deg" in row] == []
    for each in shipped():
        for name in {plain(name) for name in (each.satellite, *each.names)} & at.keys():
            assert each.longitude_deg == at[name], each


def test_the_polarisation_of_a_slot_is_that_of_the_downlink_that_a_dish_is_pointed_there_for():
    table, bands_hz = load_downlinks(), {"L": 3e9, "Ku": 13e9, "Ka": 21e9}
    for slot in slots():
        found = [each for each in table.of(0, slot.name) if each.kind and each.freq_max_hz < bands_hz[slot.band]]
        assert not found or slot.polarization in {each.kind for each in found}, slot


@pytest.mark.parametrize("longitude_deg", [-101.0, -119.0, -99.2, -103.0, -77.0])
def test_directv_and_quetzsat_are_on_the_arc(longitude_deg):
    slot = only(each for each in slots() if each.longitude_deg == longitude_deg)
    there = load_downlinks().at(longitude_deg)
    assert there, slot.name
    assert ("DIRECTV" in slot.networks) == any("DIRECTV" in each.mode for each in there)


@pytest.mark.parametrize(
    ("number", "mode", "mhz", "polarization", "pipeline"),
    [
        (44387, "HRPT", 1700.0, "RHCP", "meteor_hrpt"),
        (43010, "AHRPT", 7820.0, "RHCP", "fengyun3_d_ahrpt"),
        (49008, "AHRPT", 7860.0, "RHCP", "fengyun3_e_ahrpt"),
        (57490, "AHRPT", 7790.0, "LHCP", "fengyun3_f_ahrpt"),
        (58584, "GGAK telemetry", 1703.0, None, "arktika_ggak"),
        (58584, "RDAS: pictures", 7865.0, "RHCP", "arktika_rdas"),
        (48808, "LRIT", 1697.0, "linear", "fengyun4_b_lrit"),
        (36411, "GVAR", 1685.7, "linear", "goes_gvar"),
        (55506, "HRIT, LRIT", 1691.0, "RHCP", "elektro_lrit"),
        (39215, "Inmarsat-C, EGC", 1537.1, "RHCP", "inmarsat_std_c"),
        (33278, "Inmarsat-C, EGC", 1537.7, "RHCP", "inmarsat_std_c"),
    ],
)
def test_what_amateurs_missed_is_known_by_its_number(number, mode, mhz, polarization, pipeline):
    each = only(each for each in load_downlinks().of(number, "") if each.mode == mode)
    assert (each.center_hz, each.polarization, each.pipeline) == (mhz * 1e6, polarization, pipeline)


def test_inmarsat_4f2_is_known_by_its_number_and_ews_g2_by_its_place():
    assert {each.longitude_deg for each in load_downlinks().of(28899, "")} == {143.5}
    assert {each.satellite for each in load_downlinks().at(61.5)} == {"EWS-G2"}


def test_137_mhz_is_right_hand_circular():
    found = [each for each in shipped() if 137e6 <= each.center_hz < 138e6]
    assert len(found) >= 7
    assert {each.polarization for each in found} == {"RHCP"}


def test_fengyun_3a_and_3c_are_dead():
    assert {each.silent_since for each in load_downlinks().of(32958, "")} == {"2018"}
    assert {each.silent_since for each in load_downlinks().of(39260, "")} == {"2024-11"}


PIPELINES = """
    noaa_apt noaa_hrpt meteor_m2_lrpt meteor_m2-x_lrpt meteor_hrpt metop_ahrpt fengyun3_ab_ahrpt fengyun3_c_ahrpt
    aws_pfm arktika_ggak dmsp_rtd jpss_tlm aqua_db aura_db goes_hrit goes_grb goesr_cda goes_gvar gk2a_lrit gk2a_hrit
    elektro_lrit elektro_ggak fengyun_svissr fengyun4_b_lrit inmarsat_std_c
"""
FROM_A_RECORDING = """
    metop_dump fengyun3_d_ahrpt fengyun3_e_ahrpt fengyun3_f_ahrpt fengyun3_g_ahrpt arktika_rdas npp_hrd jpss_hrd
    terra_db gk2a_uhrit
"""
"""Read in SatDump's resources/pipelines/*.json, and whether they have a `live` entry."""


def test_each_pipeline_is_one_of_satdumps():
    piped = [each for each in shipped() if each.pipeline]
    assert {each.pipeline for each in piped if each.pipeline_live} == set(PIPELINES.split())
    assert {each.pipeline for each in piped if not each.pipeline_live} == set(FROM_A_RECORDING.split())
    assert all(each.symbol_rate_baud for each in piped if each.pipeline != "noaa_apt")
    rates = {(each.pipeline, each.symbol_rate_baud) for each in piped}
    assert len(rates) == len({name for name, _ in rates}), "a pipeline has one symbol rate"


NOW = datetime(2026, 11, 22, tzinfo=UTC)


def test_what_was_known_in_2019_is_doubtful_and_says_how_old_it_is():
    hispasat = only(each for each in shipped() if each.satellite == "Hispasat")
    assert is_doubtful(hispasat, NOW)
    assert air_words(hispasat, NOW) == "doubtful: 2019-09-25, 7 y"
    assert not is_doubtful(hispasat, datetime(2022, 9, 24, tzinfo=UTC))
    assert {each.date[:4] for each in shipped() if each.alive and not is_doubtful(each, NOW)} <= {"2025", "2026"}
    assert all(is_doubtful(each, NOW) for each in shipped() if each.date < "2023" and each.alive is not False)


def test_what_is_dead_is_not_doubtful_and_what_nobody_confirms_is():
    noaa = load_downlinks().of(33591, "")[0]
    assert (is_doubtful(noaa, NOW), air_words(noaa, NOW)) == (False, "off since 2025-08-13")
    fengyun = only(load_downlinks().of(48808, ""))
    assert (is_doubtful(fengyun, NOW), air_words(fengyun, NOW)) == (True, "doubtful: unconfirmed")


@pytest.mark.parametrize(
    ("date", "days"),
    [("2026", 0), ("2025", 326), ("2026-10", 21), ("2026-12", 0), ("2025-12", 325), ("2026-11-01", 21)],
)
def test_the_age_is_counted_from_the_end_of_what_the_date_names(own, date, days):
    table = own(f'[[downlink]]\nsatellite = "X"\nfreq_mhz = 1\nalive = true\ndate = "{date}"\n')
    assert age_days(table.entries[0], NOW) == days


def test_ones_own_entry_without_a_date_is_believed(own):
    (mine, *_) = own('[[downlink]]\nsatellite = "X"\nfreq_mhz = 1\nalive = true\n')
    assert (age_days(mine, NOW), is_doubtful(mine, NOW), air_words(mine, NOW)) == (None, False, "on the air")


def test_the_slots_of_the_dishes_stand_where_the_table_of_slots_has_them():
    for slot in slots():
        if {"DISH", "Bell"} & set(slot.networks):
            found = load_downlinks().at(slot.longitude_deg)
            assert any(each.kind == slot.polarization == "circular" for each in found), slot.name


def test_a_satellite_is_found_by_its_number_or_by_what_lists_call_it():
    table = load_downlinks()
    assert {each.mode for each in table.of(25544, "SPACE STATION")} == {"voice, SSTV", "APRS", "FM repeater"}
    assert only(table.of(0, "noaa-20")).freq_min_hz == 7812e6
    assert only(table.of(99, "IRIDIUM 106")).satellite == "Iridium"
    assert {each.mode for each in table.of(0, "GSAT0101 (GALILEO-PFM)")} == {"E1"}
    assert only(table.of(0, "RADFXSAT (FOX-1B)")).satellite == "AO-91"
    assert table.of(12345, "ISS") == (), "another number is another satellite"
    assert table.of(0, "GOES 1") == ()


def test_a_place_on_the_arc_is_found_across_the_date_line_and_not_its_neighbour():
    assert {each.satellite for each in load_downlinks().at(25.7)} == {"QO-100", "Badr"}
    assert load_downlinks().at(-128.0) == ()


def test_a_feed_hears_what_lies_in_its_band_and_is_not_known_to_be_dead():
    heard = {(each.downlink.satellite, each.downlink.mode): each for each in hearable(shipped(), HELIX)}
    assert heard["METOP-B", "AHRPT"].remark == ""
    assert heard["GOES 19", "HRIT"].loss_db == 3.0
    assert heard["GOES 19", "HRIT"].remark == "3 dB lost: linear into a feed of the other kind"
    assert heard["ELEKTRO-L 3", "HRIT, LRIT"].loss_db == 0.0
    assert heard["ARKTIKA-M 1", "GGAK telemetry"].loss_db is None, "its polarisation is not known"
    assert not [name for name, _mode in heard if name.startswith("FENGYUN 3")]
    assert not [name for name, _mode in heard if name.startswith("NOAA 1")]
    assert not [name for name, _mode in heard if name == "QO-100"]


def test_the_stock_feed_hears_the_slots_and_not_the_amateurs_just_below():
    heard = {each.downlink.satellite for each in hearable(shipped(), STOCK_FEED)}
    assert {"EchoStar 16", "Nimiq 4", "Hot Bird"} <= heard
    assert not {"QO-100", "Galaxy 19", "Galaxy 3C"} & heard, "below 12.2 GHz"
    by_name = {each.downlink.satellite: each for each in hearable(shipped(), STOCK_FEED)}
    assert by_name["EchoStar 16"].remark == ""
    assert by_name["Hot Bird"].remark == "a part of its band, 3 dB lost: linear into a feed of the other kind"
    assert by_name["Hot Bird"].center_hz == pytest.approx(12.45e9), "where this feed hears it"


def test_a_feed_without_a_band_hears_nothing_and_says_so():
    assert not has_band(FeedProfile(freq_min_hz=1e9))
    assert hearable(shipped(), FeedProfile(freq_min_hz=1e9)) == ()


def test_a_band_that_reaches_out_of_the_feeds_is_told():
    slot = only(each for each in shipped() if each.satellite == "SES 1")
    narrow = FeedProfile(freq_min_hz=12.0e9, freq_max_hz=12.7e9, polarization="circular")
    assert hearing(slot, narrow).remark == "a part of its band, 3 dB lost: linear into a feed of the other kind"


def test_the_users_own_entry_replaces_ours_and_others_are_added(own):
    table = own(
        '[[downlink]]\nsatellite = "metop b"\nfreq_mhz = 1701.3\nalive = false\n'
        '[[downlink]]\nsatellite = "My balloon"\nfreq_mhz = [433.0, 434]\nmode = "RTTY"\n'
    )
    assert table.problems == ()
    assert len(table) == len(shipped()) + 1
    mine = only(each for each in table if each.key == ("metopb", 1701300, 1701300))
    assert (mine.alive, mine.own, mine.source) == (False, True, "your own file")
    assert "METOP-B" not in {each.downlink.satellite for each in hearable(table, HELIX)}


def test_no_file_is_an_empty_one(tmp_path):
    assert load_downlinks(tmp_path / "none.toml").entries == shipped()


GOOD = '[[downlink]]\nsatellite = "X"\nfreq_mhz = 1\n'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[[downlink]]\nsatellite = "A"\n', ":4: freq_mhz is missing: one number of MHz, or [from, to]."),
        ("[[downlink]]\nfreq_mhz = 5\n", ":4: satellite is missing."),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = "5"\n', ":4: freq_mhz is '5', not a number from 0.1 to 1e+06."),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = [7, 5]\n', ":4: freq_mhz goes from 7 to 5, which is not upward."),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = [5]\n', ":4: freq_mhz has 1 numbers, not one or [from, to]."),
        ('[[downlink]]\nsatellite = "A"\nfreq_hz = 5\n', "freq_hz is not a key of a downlink; did you mean freq_mhz?"),
        (
            '[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\npolarization = "left"\n',
            ":4: polarization is 'left', not one of RHCP, LHCP, circular, horizontal, vertical, linear.",
        ),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nalive = "yes"\n', "alive is 'yes', not true, false or"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\ndate = "May"\n', "date is 'May', not a date"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nnorad_id = -1\n', "norad_id is -1, not a catalogue number."),
        (
            '[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\npipeline = "a; rm b"\n',
            "pipeline is 'a; rm b', not the name of a pipeline",
        ),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nsymbol_rate_baud = 0\n', "symbol_rate_baud is 0, not a number"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\npipeline_live = 1\n', "pipeline_live is 1, not true or false"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nnames = ["*"]\n', "names is ['*'], not a list of names"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nlongitude_deg = 190\n', "longitude_deg is 190, not a number"),
        ('[[downlink]]\nsatellite = "x"\nfreq_mhz = 1.0\n', ":4: satellite 'x' has that freq_mhz before."),
        ('[[downlnk]]\nsatellite = "A"\nfreq_mhz = 5\n', "downlnk is no table of it; did you mean downlink?"),
    ],
)
def test_a_mistake_is_told_by_file_line_and_key_and_the_rest_counts(own, tmp_path, text, told):
    table = own(GOOD + text)
    (problem,) = table.problems
    assert problem.startswith(f"{tmp_path / 'downlinks.toml'}:")
    assert told in problem
    assert [each.satellite for each in table if each.own] == ["X"]


@pytest.mark.parametrize("text", ["[[downlink\n", "x = [" * 2000, "downlink = 5\n"])
def test_a_file_that_makes_no_sense_counts_for_nothing_and_says_so(own, text):
    table = own(text)
    assert table.problems
    assert table.entries == shipped()


def test_a_file_that_is_no_text_or_no_file_says_so(tmp_path):
    path = tmp_path / "downlinks.toml"
    path.write_bytes(b"\xff\xfe\x00")
    assert "not UTF-8 text" in only(load_downlinks(path).problems)
    assert "can't be read" in only(load_downlinks(tmp_path).problems)
