"""A recording replayed on F3: what is of the past says so, what is live stays live, and no key reaches the dish."""

from __future__ import annotations

import re
from datetime import timedelta

import pytest
import stage
import stand_in
from birdcage.signal.recordings import Recording
from birdcage.signal.replay import Tape, TapePiece, TapeWindow
from birdcage.station.requests import Goto, Jog
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.strip_scale import strip_scale
from birdcage_tui.drawing.themes import DEFAULT, LOOKS
from birdcage_tui.signal.replay import ReplayScreen
from birdcage_tui.signal.replay_deck import ReplayDeck
from birdcage_tui.signal.replay_panes import ReplayPane, _write_levels
from birdcage_tui.widgets.status import BadDayRow, TopRow

from tests.signal.test_recording import NOON, recorded, row

SIZES = [(80, 24), (120, 36), (160, 48)]


def at(seconds):
    return NOON + timedelta(seconds=seconds)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """Ten minutes, a reading a second, a peak at 100 s; and an empty one after it."""
    path = tmp_path_factory.mktemp("kept") / "signal.sqlite"
    rows = [
        row(second, value=900.0 if second == 100 else 400.0 + second // 10, az_deg=180.0 + second / 100.0)
        for second in range(601)
    ]
    recorded(path, rows, {"feed": "stock-ku"})
    return path


async def settled(app, pilot):
    for _ in range(4):
        await app.workers.wait_for_complete()
        await pilot.pause()


def replayed(test, path, size=(80, 24), name="idle", keys=("enter", "p")):
    """Return what `test(app, pilot, deck)` returns of a replay that stands at its beginning."""

    async def body(app, pilot):
        await pilot.press("R")
        await settled(app, pilot)
        listed = stand_in.text_of(app)
        for key in keys:
            await pilot.press(key)
            await settled(app, pilot)
        return listed, await test(app, pilot, getattr(app.screen, "deck", None))

    return stage.run(body, name, size, key="f3", recordings_file=path)


async def text(app, pilot, _deck):
    await pilot.pause()
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_it_says_that_it_is_the_past_and_row_1_stays_live(path, size):
    listed, shown = replayed(text, path, size)
    assert "1  2026-11-24 12:00Z  10:00 long" in listed
    assert "tuner, 601 readings, 400 to 900 counts, 119W" in listed
    assert "REPLAY 2026-11-24 12:00:00Z  paused  not live" in shown
    assert shown.count("REPLAY") == 4, "the banner and each frame"
    assert "AZ 189.16°" in shown.splitlines()[0], "where the dish is now"
    assert "STOP" in shown.splitlines()[0]
    assert "dish 180.00°/42.25°  target 119W" in shown
    assert "lock yes  SNR 7.5 dB  pol V  idle" in shown
    assert "counts, mean of 10 ±1.5" in shown
    labels = [int(found[1]) for line in shown.splitlines() if (found := re.match(r"│ +(\d+)  ?[^ a-z]", line))]
    assert len(labels) >= 4, "two of either scale"
    assert all(label % 10 == 0 for label in labels[:3]), "the strip has room for round ones"


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "held", "lost"])
def test_all_of_it_can_be_seen(path, size, name):
    async def regions(app, _pilot, _deck):
        panes = [*app.screen.query(ReplayPane), *app.screen.query(TopRow), *app.screen.query(BadDayRow)]
        return [pane.region for pane in panes], app.screen.region

    _listed, (found, screen) = replayed(regions, path, size, name)
    assert len(found) == 7
    for region in found:
        assert region.area > 0
        assert screen.contains_region(region), region


def test_it_plays_pauses_goes_faster_and_waits_at_its_end(path):
    async def play(app, pilot, deck):
        told = []
        clock = app.session.clock

        async def after(seconds, *keys):
            await pilot.press(*keys)
            clock.wait(None, clock.monotonic() + seconds)
            for _ in range(3):
                app.paint()
                await settled(app, pilot)
            told.append((deck.at, deck.is_over))

        await after(5.0)  # it is paused
        await after(10.0, "p")
        await after(10.0, "plus", "plus")
        await after(0.0, "pagedown")
        await after(0.0, "left")
        for _ in range(12):
            await after(60.0)
        last = stand_in.text_of(app)
        await after(0.0, "p")
        return told, last

    _listed, (told, last) = replayed(play, path)
    moments = [moment for moment, _over in told]
    assert moments[:3] == [at(0), at(10), at(50)]
    assert moments[3:5] == [at(110), at(100)]
    assert told[-2] == (at(600), True)
    assert "at its end" in last
    assert moments[-1] == at(0), "from the beginning again"


def test_a_jump_shows_that_moment_and_what_was_highest_by_then(path):
    async def jump(app, pilot, deck):
        await pilot.press("g")
        await pilot.pause()
        await pilot.press(*"+2m", "enter")
        await settled(app, pilot)
        there = stand_in.text_of(app)
        await pilot.press("v")
        await pilot.pause()
        azimuth = stand_in.text_of(app)
        await pilot.press("home", "pagedown")
        await settled(app, pilot)
        return there, azimuth, stand_in.text_of(app)

    _listed, (there, azimuth, before) = replayed(jump, path)
    assert "level at 12:02:00Z" in there
    assert "dish 181.20°/42.25°" in there
    assert "highest so far 900 at 181.00°/42.25°, 12:01:40Z" in there
    assert "12:01:00Z to 12:02:00Z against time" in there
    assert "against azimuth" in azimuth
    assert "180.40°" in azimuth
    assert "181.40°" in azimuth, "a degree at least"
    assert "highest so far 900" not in before, "it was heard later"


def test_no_key_of_a_replay_reaches_the_dish_and_one_key_leads_back(path):
    async def press(app, pilot, _deck):
        await pilot.press("right", "left", "up", "down", "h", "j", "f", "w", "x", "n", "plus", "minus")
        await settled(app, pilot)
        inside = type(app.screen).__name__
        asked = [*app.station.asked_for(Jog), *app.station.asked_for(Goto)]
        await pilot.press("l")
        await pilot.pause()
        return inside, asked, stand_in.text_of(app)

    _listed, (inside, asked, after) = replayed(press, path)
    assert (inside, asked) == ("ReplayScreen", [])
    assert "REPLAY" not in after
    assert "To the peak" in after


def test_space_stops_the_dish_in_a_replay(path):
    async def press(app, pilot, _deck):
        await pilot.press("space")
        await pilot.pause()
        return app.station.stops, isinstance(app.screen, ReplayScreen)

    _listed, (stops, still) = replayed(press, path, name="slewing")
    assert stops
    assert still


@pytest.mark.parametrize(
    ("make", "said"),
    [(lambda path: None, "Nothing recorded yet"), (lambda path: path.write_bytes(b"x" * 4000), "is damaged")],
    ids=["none", "damaged"],
)  # fmt: skip
def test_where_there_is_nothing_to_replay_it_says_so(tmp_path, make, said):
    path = tmp_path / "signal.sqlite"
    make(path)
    listed, shown = replayed(text, path, (120, 36), keys=())
    assert said in listed + shown
    assert "REPLAY" not in shown


# The deck.


def deck(seconds=1000, window=None):
    about = Recording(1, at(0), at(seconds), "tuner", "counts", {}, False, seconds, 0.0, 1.0)
    piece = TapePiece(at(0), 0.0, 1.0, at(0), None, None, 1)
    made = ReplayDeck(Tape(about, at(0), at(seconds), (piece,)))
    if window is not None:
        made.take(
            TapeWindow(
                at(window[0]), at(window[1]), tuple(row(each) for each in range(max(window[0], 0), window[1] + 1))
            )
        )
    return made


def test_it_asks_for_the_disk_before_it_needs_it_and_waits_where_that_is_late():
    playing = deck(window=(-60, 20))
    playing.play(0.0)
    playing.play(10.0)
    assert (playing.at, playing.wanted) == (at(10), None)
    playing.play(17.0)
    begins, ends = playing.wanted
    assert begins == at(17 - 60)
    assert ends > at(20)
    playing.play(40.0)
    assert playing.at == at(20), "there is no more yet"
    playing.take(TapeWindow(begins, ends, ()))
    playing.play(41.0)
    assert playing.at == at(21), "it goes on from there, and leaps over nothing"


def test_a_jump_beyond_what_was_read_shows_nothing_of_elsewhere():
    playing = deck(window=(-60, 20))
    playing.play(0.0)
    playing.jump(at(500))
    assert playing.is_reading
    assert playing.heard == ()
    playing.play(30.0)
    assert playing.at == at(500)
    playing.jump(at(5000))
    assert playing.at == at(1000)
    playing.jump(at(-5))
    assert playing.at == at(0)
    assert [each.utc for each in playing.heard] == [at(0)], "what came later is not told before"


def test_speeds_have_ends():
    playing = deck()
    for _ in range(20):
        playing.change_speed(-1)
    assert playing.speed == 0.5
    for _ in range(20):
        playing.change_speed(1)
    assert playing.speed == 128.0


def test_one_reading_alone_is_no_division_by_nothing():
    alone = deck(seconds=0, window=(-60, 0))
    alone.play(0.0)
    assert (alone.part, alone.is_over, len(alone.heard)) == (1.0, True, 1)


def test_where_no_two_round_levels_have_room_the_ends_are_told():
    cells, canvas = Cells(40, 3), Braille(30, 2)
    _write_levels(cells, canvas, strip_scale(412.0, 545.0, 100.0, None, 2))
    written = ["".join(cells.strip(y, LOOKS[DEFAULT].inks).text).strip() for y in range(2)]
    assert written == ["552", "405"]
