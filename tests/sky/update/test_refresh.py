"""`elements update`, as a person and as a server sees it."""

from __future__ import annotations

import gzip
import json
from datetime import timedelta
from email.utils import format_datetime

import pytest
from birdcage.base.errors import ConfigError
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.refresh import Status, refresh
from birdcage.sky.update.sources import DEFAULT_GROUPS, GROUPS, POLITE_S, Source, find_sources

ETAG = {"ETag": '"v1"', "Last-Modified": "Sat, 04 Jul 2026 08:00:00 GMT"}


@pytest.fixture
def update(server, catalogue, now):
    """Update groups from the local server; returns what came of each, by name."""

    def update(*names, **more):
        sources = [Source(name, server.url(f"/{name}")) for name in names or ("weather",)]
        outcomes = list(refresh(catalogue, sources, now=now, **more))
        return outcomes[0] if len(outcomes) == 1 else {each.name: each for each in outcomes}

    return update


def test_a_group_is_fetched_and_then_asked_for_by_its_etag_only_when_two_hours_have_passed(
    server, catalogue, update, now, make
):
    server.answers["/weather"] = (200, ETAG, make(3))
    first = update()
    assert (first.status, first.added) == (Status.UPDATED, (3, 0, 0))
    assert len(catalogue.all("weather")) == 3
    assert catalogue.all("weather")[0].source == "weather"

    now.pass_by(minutes=14)
    second = update()
    assert second.status is Status.FRESH
    assert "14 min ago" in second.sentence
    assert "next from 14:00 UTC" in second.sentence
    assert len(server.asked) == 1

    now.pass_by(hours=2)
    server.answers["/weather"] = (304, {}, b"")
    third = update()
    assert (third.status, len(server.asked)) == (Status.UNCHANGED, 2)
    sent = server.asked[1][1]
    assert (sent["if-none-match"], sent["if-modified-since"]) == ('"v1"', ETAG["Last-Modified"])
    group = catalogue.groups.get("weather")
    assert (group.checked, group.fetched) == (now(), now() - timedelta(hours=2, minutes=14))
    assert update().status is Status.FRESH


def test_force_asks_sooner(server, update, make):
    server.answers["/weather"] = (200, ETAG, make(3))
    update()
    assert update(force=True).status is Status.UPDATED
    assert len(server.asked) == 2


def test_newer_elements_replace_older_ones_and_who_left_the_group_leaves_it(
    server, catalogue, update, now, make, make_omm
):
    server.answers["/weather"] = (200, {}, make(3))
    update()
    now.pass_by(hours=3)
    body = json.dumps([make_omm("SAT 1", 1, 3), make_omm("SAT 2", 2, 1), make_omm("NEW", 100123, 3)]).encode()
    server.answers["/weather"] = (200, {}, body)
    assert update().added == (1, 1, 1)
    assert [each.name for each in catalogue.all("weather")] == ["SAT 1", "NEW", "SAT 2"]
    assert catalogue.get(1).epoch.day == 3
    assert catalogue.get(3) is not None


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ((200, {"Content-Type": "text/html"}, b"<!DOCTYPE html><html>Please log in"), "web page"),
        ((200, {}, b"\n <html><body>Hotel WiFi</body></html>"), "web page"),
        ((200, {}, b'Invalid query: "GROUP=wether&FORMAT=JSON"'), "It says: Invalid query"),
        ((200, {}, b""), "sent nothing"),
        ((200, {}, b"[]"), "no elements"),
        ((200, {}, bytes(range(256)) * 10), "no elements"),
        ((200, {}, b'[{"OBJECT_NAME": "X"}]'), "no elements"),
        ((200, {}, b"<?xml version='1.0'?><ndm><omm></omm>"), "unfinished"),
        ((200, {}, b"<!DOCTYPE ndm [<!ENTITY a 'b'>]><ndm/>"), "document type"),
        ((404, {}, b"not here"), "answers 404"),
        ((500, {}, b""), "answers 500"),
        ((304, {}, b""), "answers 304"),
        ((200, {"Content-Encoding": "gzip"}, gzip.compress(b"[]" * 99)[:-9]), "broke off"),
    ],
)
def test_what_is_no_group_is_refused_and_the_old_one_stays(server, catalogue, update, now, make, answer, words):
    if answer[0] != 304:
        server.answers["/weather"] = (200, ETAG, make(3))
        update()
        now.pass_by(days=2)
    before, notes = catalogue.all(), catalogue.groups.get("weather")
    server.answers["/weather"] = answer
    outcome = update()
    assert outcome.status is Status.FAILED
    assert words in outcome.sentence
    if before:
        assert "The 3 satellites of 2 d ago stay." in outcome.sentence
    assert catalogue.all() == before
    after = catalogue.groups.get("weather")
    assert (after.etag, after.fetched, after.checked) == (notes.etag, notes.fetched, notes.checked)
    assert words in after.problem


@pytest.mark.parametrize("cut", [1, 2, 100, 400])
def test_json_that_was_cut_anywhere_takes_nothing_from_it(server, catalogue, update, now, make, cut):
    server.answers["/weather"] = (200, {}, make(3))
    update()
    now.pass_by(days=1)
    before = catalogue.all()
    server.answers["/weather"] = (200, {}, make(3, day=3)[:-cut])
    assert update().status is Status.FAILED
    assert catalogue.all() == before


def test_a_tle_file_with_a_damaged_line_is_taken_without_it_and_says_where(server, catalogue, update, make):
    iss = (
        "ISS (ZARYA)\n"
        "1 25544U 98067A   08264.51782528 -.00002182  00000-0 -11606-4 0  2927\n"
        "2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391563537\n"
    )
    damaged = iss.replace("ZARYA", "BROKEN").replace("15.72125391563537", "15.72125391563530")
    server.answers["/weather"] = (200, {"Content-Type": "text/plain"}, (iss + damaged).encode())
    outcome = update()
    assert outcome.status is Status.UPDATED
    assert [each.name for each in catalogue.all("weather")] == ["ISS (ZARYA)"]
    assert len(outcome.complaints) == 1
    assert outcome.complaints[0].line in (5, 6)
    assert "1 damaged" in outcome.sentence


def test_a_group_that_shrinks_to_less_than_half_keeps_its_members(server, catalogue, update, now, make):
    server.answers["/weather"] = (200, {}, make(10))
    update()
    now.pass_by(hours=3)
    server.answers["/weather"] = (200, {}, make(4, day=2))
    outcome = update()
    assert "There were 10" in outcome.sentence
    assert len(catalogue.all("weather")) == 10
    now.pass_by(hours=3)
    server.answers["/weather"] = (200, {}, make(6, day=3))
    update()
    assert len(catalogue.all("weather")) == 6


def test_satnogs_and_gzip(server, catalogue, update):
    rows = [
        {
            "tle0": "0 ISS (ZARYA)",
            "tle1": "1 25544U 98067A   08264.51782528 -.00002182  00000-0 -11606-4 0  2927",
            "tle2": "2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391563537",
            "tle_source": "Space-Track.org", "sat_id": "XSKZ-5603-1870-9019-3066", "norad_cat_id": 25544,
            "updated": "2008-09-20T13:00:00.000000+0000",
        }
    ]  # fmt: skip
    server.answers["/satnogs"] = (200, {"Content-Encoding": "gzip"}, gzip.compress(json.dumps(rows).encode()))
    assert update("satnogs").status is Status.UPDATED
    assert catalogue.get("ISS (ZARYA)").norad_id == 25544


def test_one_group_that_fails_costs_no_other(server, catalogue, update, make):
    server.answers["/weather"] = (200, {}, b"garbage")
    server.answers["/geo"] = (200, {}, make(3))
    outcomes = update("weather", "geo")
    assert outcomes["weather"].status is Status.FAILED
    assert outcomes["geo"].status is Status.UPDATED
    assert len(catalogue.all("geo")) == 3


def test_a_403_pauses_the_whole_server_and_force_does_not_break_it(server, catalogue, update, now, make):
    server.answers["/weather"] = (403, {}, b"You have been blocked.\nRead the rules.")
    server.answers["/geo"] = (200, {}, make(3))
    outcomes = update("weather", "geo")
    assert {each.status for each in outcomes.values()} == {Status.PAUSED}
    assert "refuses (403): You have been blocked. Read the rules" in outcomes["weather"].sentence
    assert "before 14:00 UTC" in outcomes["geo"].sentence
    now.pass_by(minutes=119)
    assert update("geo", force=True).status is Status.PAUSED
    assert len(server.asked) == 1
    now.pass_by(minutes=1)
    assert update("geo").status is Status.UPDATED


def test_celestraks_403_for_what_has_not_changed_pauses_this_group_alone(server, catalogue, update, now, make):
    server.answers["/weather"] = server.answers["/geo"] = (200, {}, make(3))
    update()
    text = b"GP data has not updated since your last successful\ndownload of GROUP=weather at 2026-07-04 12:00:00 UTC."
    server.answers["/weather"] = (403, {}, text)
    outcomes = update("weather", "geo", force=True)
    assert outcomes["weather"].status is Status.PAUSED
    assert "nothing newer than what it last sent" in outcomes["weather"].sentence
    assert outcomes["geo"].status is Status.UPDATED
    assert update("weather", force=True).status is Status.PAUSED
    assert len(server.asked) == 3


@pytest.mark.parametrize(
    ("retry_after", "minutes"),
    [("600", 10), ("DATE", 30), ("", 60), ("soon", 60), ("-5", 60), ("99999999999999999999", 24 * 60)],
)
def test_a_429_is_left_alone_as_long_as_it_says(server, update, now, make, retry_after, minutes):
    date = format_datetime(now() + timedelta(minutes=30), usegmt=True)
    server.answers["/weather"] = (429, {"Retry-After": date if retry_after == "DATE" else retry_after}, b"")
    outcome = update()
    assert outcome.status is Status.PAUSED
    assert outcome.next_at == now() + timedelta(minutes=minutes)
    now.pass_by(minutes=minutes - 1)
    assert update(force=True).status is Status.PAUSED
    assert len(server.asked) == 1
    now.pass_by(minutes=1)
    server.answers["/weather"] = (200, {}, make(3))
    assert update().status is Status.UPDATED


def test_a_clock_that_was_years_ahead_does_not_forbid_to_ask_for_years(server, update, now, make):
    server.answers["/weather"] = (429, {}, b"")
    server.answers["/geo"] = (200, {}, make(3))
    now.pass_by(days=3650)
    update("geo")
    update("weather")
    now.pass_by(days=-3650)
    assert update("geo").status is Status.UPDATED


def test_no_network_is_a_sentence_and_the_old_elements_stay(server, catalogue, update, now, make):
    server.answers["/weather"] = (200, {}, make(3))
    update()
    server.close()
    now.pass_by(days=4)
    outcome = update()
    assert outcome.status is Status.FAILED
    assert "cannot be reached" in outcome.sentence
    assert "The 3 satellites of 4 d ago stay." in outcome.sentence
    assert len(catalogue.all()) == 3


def test_a_server_that_is_not_there_is_tried_once_a_run(server, update):
    def ask(url, **_more):
        asked.append(url)
        raise FetchError("Nobody there.", reason="timeout")

    asked = []
    outcomes = update("weather", "geo", ask=ask)
    assert [each.status for each in outcomes.values()] == [Status.FAILED] * 2
    assert asked == [server.url("/weather")]


def test_another_address_for_a_group_is_asked_without_the_old_ones_etag(server, catalogue, update, now, make):
    server.answers["/weather"] = (200, ETAG, make(3))
    server.answers["/mirror"] = (200, {}, make(3))
    update()
    (outcome,) = refresh(catalogue, [Source("weather", server.url("/mirror"))], now=now)
    assert outcome.status is Status.UPDATED
    assert "if-none-match" not in server.asked[1][1]


def test_a_satellite_that_was_removed_comes_back_with_the_next_update(server, catalogue, update, make):
    server.answers["/weather"] = (200, ETAG, make(3))
    update()
    catalogue.remove([2])
    assert update().status is Status.UPDATED
    assert "if-none-match" not in server.asked[1][1]
    assert len(catalogue.all("weather")) == 3


def test_the_sources_are_celestraks_in_json_and_satnogs_and_a_mirror_takes_their_place():
    assert set(DEFAULT_GROUPS) < set(GROUPS)
    fault_mix, iridium, satnogs = find_sources(("WEATHER", "iridium-next", "satnogs", "weather"))[:3]
    assert fault_mix.url == "https://celestrak.org/NORAD/elements/gp.php?GROUP=weather&FORMAT=JSON"
    assert fault_mix.polite_s == POLITE_S == 7200
    assert iridium.url.endswith("GROUP=iridium-NEXT&FORMAT=JSON")
    assert satnogs.url == "https://db.satnogs.org/api/tle/?format=json"
    (mine,) = find_sources(("my birds",), mirror_url="http://nas/{group}.json")
    assert (mine.url, mine.polite_s) == ("http://nas/my%20birds.json", 0.0)
    with pytest.raises(ConfigError, match="did you mean weather"):
        find_sources(("wether",))


def test_a_group_with_elements_dated_ahead_is_fetched_whole_until_it_is_healed(server, catalogue, update, now, make):
    """It may be the clock that was behind: then the tag of that day must not keep the good ones away."""
    server.answers["/weather"] = (200, ETAG, make(3))
    now.pass_by(days=-400)
    first = update()
    assert first.status is Status.UPDATED
    assert "more than 7 days ahead of this computer's clock" in first.sentence
    assert len(catalogue.all("weather")) == 3, "nothing is thrown away"
    now.pass_by(days=400)
    second = update()
    assert (second.status, "ahead" in second.sentence) == (Status.UPDATED, False)
    now.pass_by(hours=3)
    update()
    tags = ["if-none-match" in headers for _path, headers in server.asked]
    assert tags == [False, False, True]
