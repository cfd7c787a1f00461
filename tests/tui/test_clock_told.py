"""What F1 says of this machine's clock: in words and with a glyph, found out on a thread, never waited for."""

import threading
import time
from datetime import UTC, datetime

import pytest
import stage
import stand_in
from birdcage.base.clock import RealClock, ScaledClock
from birdcage.base.paths import throw_away_paths
from birdcage.gps.verdict import ClockVerdict
from birdcage_tui.feeds.clock_watch import ClockWatch, make_check
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.shown.clock_told import ClockTold, clock_told

NOW = datetime(2026, 3, 20, 12, tzinfo=UTC)
GOOD = ClockVerdict("network", "network time (chrony)", NOW, None, 0.02)
SLOW = ClockVerdict("gps", "gpsd", NOW, -3.0, 0.1, "The clock is 3.0 s slow by gpsd: set it.")
OLD = ClockVerdict("remembered", "gpsd, 9 days ago", NOW, 0.2, 18.0, "It may be 18.2 s off now.")
UNKNOWN = ClockVerdict("unknown", "none", NOW, doubt="This system does not tell whether its clock is right.")
SIZES = [(120, 36), (160, 48), (200, 60)]


@pytest.mark.parametrize(
    ("verdict", "glyph", "words"),
    [
        (GOOD, "●", "NTP ±0.02 s"),
        (ClockVerdict("gps", "gpsd", NOW, 0.1, 0.1), "●", "GPS ±0.20 s"),
        (ClockVerdict("network", "network time (systemd)", NOW), "●", "NTP"),
        (ClockVerdict("watch", "your watch", NOW, 0.5, 1.0), "●", "your watch ±1.5 s"),
        (ClockVerdict("remembered", "gpsd, 3 h ago", NOW, 0.1, 0.3), "●", "by gpsd, 3 h ago ±0.40 s"),
        (UNKNOWN, "·", "unknown"),
        (SLOW, "▲", "doubtful: 3.0 s slow, ±3.1° overhead"),
        (OLD, "▲", "doubtful: ±18.2 s, ±18.2° overhead"),
        (ClockVerdict("gps", "gpsd", NOW, 7200.0, 0.1, "2 h fast."), "▲", "doubtful: 2 h fast, targets can't be found"),
        (ClockVerdict("network", "chrony", NOW, doubt="No source."), "▲", "doubtful"),
    ],
)
def test_a_verdict_in_words(verdict, glyph, words):
    told = clock_told(verdict)
    assert (told.glyph, told.words) == (glyph, words)
    assert bool(told.doubt) == verdict.doubtful


def test_a_doubt_says_what_a_second_costs():
    assert "One second costs 1° on the space station overhead" in clock_told(SLOW).cost
    assert clock_told(GOOD).cost == ""


def run(told, size, name="idle"):
    async def show(app, pilot):
        app.feeds.hear_clock(told)
        app.paint()
        await pilot.pause()
        await pilot.pause()
        pane = app.query_one(HealthPane)
        rows = ["".join(segment.text for segment in strip).rstrip() for strip in pane._strips]
        return stand_in.text_of(app), rows

    return stage.run(show, name, size)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("verdict", [GOOD, SLOW, UNKNOWN], ids=lambda verdict: verdict.kind)
def test_health_holds_it_whole_and_nothing_else_is_pushed_out(size, verdict):
    told = clock_told(verdict)
    _, rows = run(told, size)
    assert any(f"{told.glyph} clock     {told.words}" in row for row in rows), rows
    shared = {"port": "sim:g2, heard", "offsets": "offset +"}
    for name in ("link", "port", "homed", "TV search", "limits", "firmware", "feed", "offsets"):
        words = shared.get(name, name) if size == SIZES[0] else name
        assert any(words in row for row in rows), rows


@pytest.mark.parametrize("size", [(80, 24), (100, 30), *SIZES], ids=str)
def test_row_two_has_it_at_every_size(size):
    text, _ = run(clock_told(GOOD), size)
    assert "clock NTP ±0.02 s" in text.splitlines()[1]
    text, _ = run(clock_told(SLOW), size)
    assert "▲ clock doubtful: 3.0 s slow, ±3.1° overhead" in text.splitlines()[1]


@pytest.mark.parametrize(
    ("verdict", "row"),
    [
        (OLD, "▲ clock ±18.2 s, ±18.2° overhead"),
        (SLOW, "▲ clock 3.0 s slow, ±3.1° overhead"),
        (GOOD, "Ku LNB  beam 2.6° x 2.6°  EN10"),
    ],
)
def test_the_pocket_view_has_only_a_doubt_and_has_it_whole(verdict, row):
    async def show(app, pilot):
        app.feeds.hear_clock(clock_told(verdict))
        app.paint()
        await pilot.pause()
        return [each.strip() for each in stand_in.text_of(app).splitlines()]

    assert row in stage.run(show, size=(40, 12))


def test_what_to_do_and_what_it_costs_stand_under_what_next_where_there_is_room():
    text, _ = run(clock_told(SLOW), (200, 60))
    assert "▲ The clock is 3.0 s slow by gpsd: set it." in text
    assert "One second costs 1°" in text


def test_before_it_was_checked_it_is_a_dash():
    async def look(app, pilot):
        return HealthPane.facts(app.view())

    facts = {name: value for _, name, value in stage.run(look)}
    assert facts["clock"] == "--"


def test_the_app_checks_on_a_thread_after_its_first_frame(monkeypatch):
    monkeypatch.setattr("birdcage_tui.feeds.clock_watch.FIRST_S", 0.0)
    release, threads = threading.Event(), []

    def check():
        threads.append(threading.current_thread())
        release.wait(5.0)
        return clock_told(GOOD)

    async def wait(app, pilot):
        before = stand_in.text_of(app)
        release.set()
        for _ in range(100):
            await pilot.pause(0.01)
            if app.view().clock is not None:
                break
        app.paint()
        await pilot.pause()
        return before, stand_in.text_of(app)

    before, after = stage.run(wait, clock_check=check)
    assert "IDLE" in before, "the app is there while the check lasts"
    assert "clock" not in before
    assert "clock NTP ±0.02 s" in after
    assert threads
    assert all(thread is not threading.main_thread() for thread in threads)


def test_it_is_checked_again_and_again_until_it_is_closed(monkeypatch):
    monkeypatch.setattr("birdcage_tui.feeds.clock_watch.FIRST_S", 0.0)
    monkeypatch.setattr("birdcage_tui.feeds.clock_watch.AGAIN_S", 0.001)
    enough, shown = threading.Event(), []

    def show(told):
        shown.append(told)
        if len(shown) == 3:
            watch.close()
            enough.set()

    watch = ClockWatch(lambda: ClockTold("NTP", "●", "good"), show)
    watch.begin()
    assert enough.wait(5.0)
    time.sleep(0.02)
    assert len(shown) == 3


def test_without_a_check_no_thread_is_made():
    before = threading.active_count()
    ClockWatch(None, print).begin()
    assert threading.active_count() == before


def test_a_clock_that_runs_faster_is_simulated_and_a_real_one_is_checked(monkeypatch):
    monkeypatch.setattr("birdcage.gps.clock_check.check_clock", lambda *_: GOOD)
    with throw_away_paths() as paths:
        assert make_check(ScaledClock(20), paths)().words == "simulated, 20 times as fast"
        assert make_check(RealClock(), paths)() == clock_told(GOOD)
