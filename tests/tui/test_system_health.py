"""F4, Health: what needs attention comes first, with what to do; what was seen goes until it happens again."""

import re

import health_stand_in
import pytest
import stand_in
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.station.requests import Read
from birdcage_tui.feeds.health_feed import HealthFeed
from birdcage_tui.system.detail_pane import DetailPane
from birdcage_tui.system.findings_pane import FindingsPane
from birdcage_tui.system.health_figures import LinkFiguresPane, MotorFiguresPane
from stage import run

from tests.diagnostics.made_history import MadeHistory

SIZES = [(80, 24), (120, 36), (160, 48)]


def shown(now, size=(120, 36), *keys):
    async def look(app, pilot):
        app.system.health.now = now
        await pilot.press("f4", *keys)
        await pilot.pause()
        app.system.health.now = now
        app.paint()
        await pilot.pause()
        kinds = (FindingsPane, MotorFiguresPane, LinkFiguresPane, DetailPane)
        return stand_in.text_of(app), [app.query_one(kind).region for kind in kinds]

    return run(look, size=size)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_most_urgent_comes_first_with_what_to_do_beside_it(size):
    text, regions = shown(health_stand_in.NOW, size)
    assert text.index("▲ now  EL stalled twice since Tuesday") < text.index("· note Sleep timer")
    assert "Look at the cable by the arm." in text
    assert re.search(r"stalls, 30 d +0 +2", text)
    assert re.search(r"turns in all +1,204 +--", text), "what is not known is a dash"
    assert "9 ms, 3 of 41,220 lost" in text
    for region in regions:
        assert region.height >= 5
        assert region.right <= size[0]
        assert region.bottom <= size[1] - 1


@pytest.mark.parametrize("size", SIZES[1:], ids=str)
def test_where_there_is_room_the_days_stand_one_beside_the_other(size):
    text, _ = shown(health_stand_in.NOW, size)
    rows = {name: line.split(name)[1].split("│")[0].split() for line in text.splitlines()
            for name in ("stalls    ", "lost replies") if name in line and ", 30 d" not in line}  # fmt: skip
    days = {name: [day for word in words for day in word] for name, words in rows.items()}
    assert days["stalls    "].index("1") == 4
    assert days["lost replies"].index("▲") == 8, "more than a digit holds"
    assert "10 Mar" in text
    assert "08 Apr" in text


def test_where_nothing_is_wrong_it_says_so_and_what_was_looked_at():
    text, _ = shown(health_stand_in.WELL)
    assert "● Nothing needs attention." in text
    assert "Looked at 30 days." in text


def test_what_goes_by_itself_cannot_be_acknowledged():
    text, _ = shown(health_stand_in.NOW, (120, 36), "down", "a")
    assert "it clears when its cause is gone" in text


class Beside:
    """Does work at once, and notes that it was done beside the app's thread."""

    def __init__(self):
        self.times = 0

    def __call__(self, work):
        self.times += 1
        work()


def feed_of(station, clock, journal):
    beside = Beside()
    feed = HealthFeed(station, clock, lambda work: work(), lambda: None, journal, settings=lambda: None, beside=beside)
    return feed, beside


def in_a_state(clock):
    station = stand_in.Station(stand_in.at_rest(clock))
    assert station.state.dish is CARRYOUT_G2
    return station


def test_it_is_judged_beside_on_arrival_and_now_and_then_only_while_somebody_looks(tmp_path):
    clock = stand_in.VirtualClock()
    feed, beside = feed_of(in_a_state(clock), clock, tmp_path / "journal.sqlite")
    assert beside.times == 0
    feed.look()
    assert (beside.times, feed.now.health is not None) == (1, True)
    for _ in range(3):
        clock.advance(1.0)
        feed.look()
    assert beside.times == 1
    clock.advance(60.0)
    feed.look()
    assert beside.times == 2


def test_a_dish_that_rests_is_asked_for_what_the_rules_look_at_once_a_minute(tmp_path):
    clock = stand_in.VirtualClock()
    station = in_a_state(clock)
    feed, _ = feed_of(station, clock, tmp_path / "journal.sqlite")
    for _ in range(30):
        feed.look()
        clock.advance(1.0)
    (asked,) = station.asked_for(Read)
    assert "driver.azimuth" in asked.features


def test_a_finding_that_was_acknowledged_goes_and_a_new_stall_brings_it_back(tmp_path):
    clock = stand_in.VirtualClock()
    station = in_a_state(clock)
    journal = tmp_path / "journal.sqlite"
    utc = clock.utc()
    made = MadeHistory(dish="Carryout G2 (demo)")
    made.at = lambda days_ago, hour=12.0: utc  # now, whatever the day
    made.stall(0, "elevation", 190.0, 62.0).write(journal)
    feed, _ = feed_of(station, clock, journal)
    said = []
    feed.look()
    (finding,) = [each for each in feed.now.health.findings if each.id.startswith("stall")]
    feed.acknowledge(finding, said.append)
    assert said == ["Acknowledged until it happens again."]
    assert not any(each.id == finding.id for each in feed.now.health.findings)
    clock.advance(3600.0)
    later = clock.utc()
    made = MadeHistory(dish="Carryout G2 (demo)")
    made.at = lambda days_ago, hour=12.0: later
    made.stall(0, "elevation", 190.0, 65.0).write(journal)
    feed.read()
    assert any(each.id == finding.id for each in feed.now.health.findings)


def test_a_journal_that_is_none_is_told_and_nothing_is_lost(tmp_path):
    clock = stand_in.VirtualClock()
    journal = tmp_path / "journal.sqlite"
    journal.write_bytes(b"this is no database" * 100)
    feed, _ = feed_of(in_a_state(clock), clock, journal)
    feed.look()
    health = feed.now.health
    assert health is not None
    assert any("history is not available" in each.text for each in health.findings)
    assert journal.read_bytes().startswith(b"this is no database")
