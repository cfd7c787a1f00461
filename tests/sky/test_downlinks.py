"""Who sends what: the table that ships, the user's own over it, and what a feed can hear of it."""

from __future__ import annotations

import pytest
from birdcage.base.config import FeedProfile
from birdcage.base.config.feeds import STOCK_FEED
from birdcage.sky.downlinks import load_downlinks, plain, shipped
from birdcage.sky.downlinks_hearing import has_band, hearable, hearing
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
        ('alive = false\nsilent_since = "May"', "silent_since is 'May', not such as 2025-08-13"),
    ):
        assert words in only(own(row.format(wrong)).problems)


def test_no_satellite_stands_in_two_places():
    at = {plain(name): slot.longitude_deg for slot in slots() for name in (slot.name, *slot.aliases)}
    both = 0
    for each in shipped():
        for name in {plain(name) for name in (each.satellite, *each.names)} & at.keys():
            assert each.longitude_deg == pytest.approx(at[name], abs=0.25), each
            both += 1
    assert both >= 8


def test_the_slots_of_the_dishes_stand_where_the_table_of_slots_has_them():
    for slot in slots():
        if slot.network in ("DISH", "Bell"):
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
    assert heard["ELEKTRO-L 3", "HRIT, LRIT"].loss_db is None, "its polarisation is not known"
    assert ("FENGYUN 3C", "AHRPT") in heard, "nobody says it is dead"
    assert not [name for name, _mode in heard if name.startswith("NOAA 1")]
    assert not [name for name, _mode in heard if name == "QO-100"]


def test_the_stock_feed_hears_the_slots_and_not_the_amateurs_just_below():
    heard = {each.downlink.satellite for each in hearable(shipped(), STOCK_FEED)}
    assert {"EchoStar 16", "Nimiq 4", "Hot Bird"} <= heard
    assert "QO-100" not in heard


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
        ('[[downlink]]\nsatellite = "A"\nfreq_hz = 5\n', "freq_hz is no key of a downlink; did you mean freq_mhz?"),
        (
            '[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\npolarization = "left"\n',
            ":4: polarization is 'left', not one of RHCP, LHCP, circular, horizontal, vertical, linear.",
        ),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nalive = "yes"\n', "alive is 'yes', not true, false or"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\ndate = "May"\n', "date is 'May', not such as 2026-10-16"),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nnorad_id = -1\n', "norad_id is -1, not a catalogue number."),
        ('[[downlink]]\nsatellite = "A"\nfreq_mhz = 5\nnames = ["*"]\n', "names is ['*'], not a list such as"),
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
    assert "no UTF-8 text" in only(load_downlinks(path).problems)
    assert "can't be read" in only(load_downlinks(tmp_path).problems)
