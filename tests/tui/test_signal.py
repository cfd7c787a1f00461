"""The signal strip: who is listened to, what is said of it, and the demo's satellites heard through its own beam."""

from __future__ import annotations

import asyncio
import re
from dataclasses import replace

import pytest
import stage
import stand_in
import track_stage
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.config.feeds import FeedProfile, FeedSettings
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio.now import RadioState
from birdcage.signal.monitor import SignalMonitor
from birdcage.signal.receiver import ReceiverSource
from birdcage.signal.source import Scale, SignalFacts, SignalReading
from birdcage.signal.source_set import SourceSet
from birdcage.signal.tuner import TUNER_FACTS, TunerSource
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Unwatch, Watch
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.signal_book import SignalBook
from birdcage_tui.shown.view import View
from test_demo import stage_of_the_pictures, until

from tests.radio.scripted import Desk, sdr

RECEIVER_FACTS = SignalFacts(
    "rigctl", "receiver", "dB", Scale.LOG, 1.0, 2.5, None, None, 1, 10.0, None, of_dish=False, demo=False
)


def said(app):
    """The words of the strip, as one reads them."""
    return " ".join("".join("".join(row) for row in app.query_one(SignalPane)._cells._chars).split())


def columns(app):
    """The columns of the strip: `#` where the curve is drawn, in its own ink, else `-`."""
    inks = app.query_one(SignalPane)._cells._inks[1:]
    return "".join("#" if "accent" in column else "-" for column in zip(*inks, strict=True)).rstrip("-")


class Book:
    """A book, and the time."""

    def __init__(self):
        self.clock = VirtualClock()
        self.state = stand_in.at_rest(self.clock)
        self.book = SignalBook()

    def hear(self, facts, value):
        self.clock.advance(1.0)
        at = self.clock.monotonic()
        position = self.state.position
        if position is not None:
            self.state = replace(self.state, position=replace(position, at=at - 0.2))
        self.book.hear(SignalReading(value, facts.unit, at, self.clock.utc(), facts.id), facts, self.state)

    def tuner(self, counts):
        self.hear(TUNER_FACTS, counts)

    def receiver(self, strength_db):
        self.hear(RECEIVER_FACTS, strength_db)

    @property
    def told(self):
        return self.book.heard.label, self.book.heard.unit, [each.value for each in self.book.samples]


def test_the_tuner_counts_until_a_receiver_tells_and_again_after_it():
    here = Book()
    assert here.told == ("tuner", "counts", [])
    here.tuner(500.0)
    here.receiver(-50.0)
    here.receiver(-40.0)
    here.tuner(510.0)
    assert here.told == ("receiver", "dB", [-50.0, -40.0]), "the pass is still on"
    here.clock.advance(RECEIVER_FACTS.pause_s)
    assert here.told[0] == "receiver", "nothing newer was told"
    here.tuner(520.0)
    assert here.told == ("tuner", "counts", [500.0, 510.0, 520.0])


def test_where_the_receiver_hears_the_feed_the_tuner_is_not_shown():
    here = Book()
    here.tuner(500.0)
    here.book.chosen = RECEIVER_FACTS
    assert here.told == ("receiver", "dB", [])
    here.tuner(510.0)
    assert here.told == ("receiver", "dB", [])


def test_where_it_was_heard_is_kept_and_not_guessed():
    here = Book()
    here.receiver(-40.0)
    here.state = replace(here.state, position=None)
    here.receiver(-41.0)
    known, unknown = here.book.samples
    assert (known.az_deg, known.el_deg) == (stand_in.at_rest(here.clock).position.az_deg, 42.87)
    assert (unknown.az_deg, unknown.el_deg) == (None, None)


@pytest.mark.parametrize("state", ["lost", "silent", "late", "travler-slew", "not-homed"])
def test_a_receiver_is_heard_nowhere_while_nobody_knows_where_the_dish_looks(state):
    clock = VirtualClock()
    book, reading = SignalBook(), SignalReading(-40.0, "dB", clock.monotonic(), clock.utc(), "rigctl")
    book.chosen = RECEIVER_FACTS
    book.hear(reading, RECEIVER_FACTS, stand_in.STATES[state](clock))
    assert [(each.value, each.az_deg, each.el_deg) for each in book.samples] == [(-40.0, None, None)]


@pytest.mark.parametrize("state", ["slewing", "idle"])
def test_a_receiver_is_heard_where_the_dish_was_just_read(state):
    clock = VirtualClock()
    book, now = SignalBook(), stand_in.STATES[state](clock)
    reading = SignalReading(-40.0, "dB", clock.monotonic(), clock.utc(), "rigctl")
    book.hear(reading, RECEIVER_FACTS, now)
    assert [each.az_deg for each in book.samples] == [now.position.az_deg]
    clock.advance(1.0)
    book.hear(replace(reading, at=clock.monotonic()), RECEIVER_FACTS, now)
    assert book.samples[-1].az_deg == (None if state == "slewing" else now.position.az_deg), "it has moved on since"


class Sources:
    """The two sources of a session, the feed being heard by the receiver; that one is scripted."""

    def __init__(self, answer=None, *, feed="rigctl"):
        self.answer, self.feed = answer or sdr(strength="-38.2"), feed
        self.session = self.receiver = self.desk = None

    def monitor(self, hear):
        clock, station = self.session.clock, self.session.station
        self.desk = Desk(clock, self.answer)
        settings = Settings(radio=RadioSettings(rigctld="radio:4532"))
        self.receiver = ReceiverSource(station, settings, clock, threads=False, connect=self.desk)
        return SignalMonitor([TunerSource(station), self.receiver], self.feed, hear)

    def chosen_now(self):
        return self.feed


SIZES = [(80, 24), (120, 36), (160, 48)]


async def listen(app, pilot, seconds):
    """Let the receiver have its time, and paint what came."""
    sources = app.settings.signal
    end = app.session.clock.monotonic() + seconds
    while app.session.clock.monotonic() < end:
        app.session.clock.wait(None, min(sources.receiver.step(), end))
        await pilot.pause()
    app.paint()
    await pilot.pause()
    await pilot.pause()
    return stand_in.text_of(app)


def on_f1(play, sources, name="idle", size=(80, 24)):
    async def body():
        app = stand_in.app_in(name, heard=False, signal=sources)
        sources.session = app.session
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            return await play(app, pilot)

    return asyncio.run(body())


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "slewing", "held", "lost", "silent", "opening", "travler", "travler-slew"])
def test_the_receiver_is_shown_while_the_dish_rests_moves_or_is_not_there(name, size):
    async def look(app, pilot):
        return await listen(app, pilot, 12.0), app.station.asked_for(Watch)

    text, watches = on_f1(look, Sources(), name, size)
    assert " -38.2 dB" in text
    assert "receiver" in text
    assert "peak -38.2" in text
    assert "counts" not in text
    assert "tuner" not in text
    assert not any("rssi" in watch.features for watch in watches), "the dish is not asked for it"
    if name in ("lost", "silent", "opening"):
        assert "peak -38.2 at" not in text, "nobody knows where the dish looks"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_tuner_is_shown_where_the_feed_names_it_and_the_receiver_is_left_alone(size):
    sources = Sources(feed="tuner")

    async def look(app, pilot):
        app.signals.book.of(TUNER_FACTS).extend(stand_in.samples(app.session.clock))
        text = await listen(app, pilot, 1.0)
        return text, app.station.asked_for(Watch)

    text, watches = on_f1(look, sources, size=size)
    assert " counts" in text
    assert "tuner" in text
    assert any("rssi" in watch.features for watch in watches)
    assert sources.desk.connected == 0


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_who_has_the_receiver_is_named_beside_it(size):
    async def look(app, pilot):
        await listen(app, pilot, 5.0)
        app.station.own_signal("rigctl", "LEO 1")
        app.paint()
        await pilot.pause()
        await pilot.pause()
        return stand_in.text_of(app)

    text = on_f1(look, Sources(), size=size)
    assert "receiver, LEO 1" in text
    assert "peak -38.2" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (lambda _line: b"", "No answer to 'f' within 2 s"),
        (lambda _line: b"SSH-2.0-OpenSSH_9.2\n", "that is not rigctld"),
        (sdr(strength=None), "No level: SDR++ advertises one and answers RPRT 1."),
    ],
    ids=["silent", "garbage", "refuses"],
)
def test_a_receiver_that_tells_nothing_has_a_dash_and_says_why(answer, words, size):
    async def look(app, pilot):
        await listen(app, pilot, 5.0)
        return said(app)

    text = on_f1(look, Sources(answer), size=size)
    assert "-- dB" in text
    assert words in text
    assert "peak" not in text


def test_a_receiver_that_vanishes_leaves_a_gap_and_goes_on_when_it_returns():
    async def look(app, pilot):
        sources = app.settings.signal
        await listen(app, pilot, 10.0)
        sources.desk.there = False
        await listen(app, pilot, 15.0)
        gone = said(app)
        sources.desk.there = True
        await listen(app, pilot, 10.0)
        return gone, said(app), columns(app)

    gone, back, drawn = on_f1(look, Sources(), size=(120, 36))
    assert "s old" in gone
    assert "-38.2 dB" in back
    assert "s old" not in back
    assert re.fullmatch("-*#{6,10}-{10,16}#{2,10}", drawn), "a gap, not a slope"


def test_another_feed_brings_its_own_source():
    async def look(app, pilot):
        sources = app.settings.signal
        await listen(app, pilot, 3.0)
        sources.feed = "tuner"
        await pilot.press("f8")
        await pilot.pause()
        app.station.state = replace(app.station.state, feed_name="stock-ku")
        await pilot.press("f1")
        await pilot.pause()
        await listen(app, pilot, 3.0)
        return said(app), sources.desk.open, app.station.asked_for(Watch)

    text, still_open, watches = on_f1(look, Sources(), size=(120, 36))
    assert text == "Nothing heard yet. The tuner is read while the dish rests."
    assert still_open == 0
    assert any("rssi" in watch.features for watch in watches)


def test_a_feed_of_the_receiver_is_heard_by_it_from_then_on():
    """As the app has it: the receiver of the settings, opened by its address once the feed wants it."""
    by_receiver = Settings(
        feed=FeedSettings("helix"), feeds={"helix": FeedProfile(signal="rigctl")},
        radio=RadioSettings(rigctld="sim:rig"),
    )  # fmt: skip
    clock, heard = VirtualClock(), []
    session = stand_in.Session(stand_in.at_rest(clock), clock)
    signals = SourceSet(Settings(), clock, lambda: by_receiver, threads=False)
    signals.attach(session.station)
    monitor = signals.monitor(heard.append)
    monitor.watch(on=True)
    assert monitor.chosen.facts.id == "tuner"
    monitor.choose(signals.chosen_now())
    end = clock.monotonic() + 5.0
    while clock.monotonic() < end:
        clock.wait(None, min(signals.receiver.step(), end))
    assert {reading.source for reading in heard} == {"rigctl"}
    assert 4 <= len(heard) <= 6
    assert isinstance(session.station.asked[-1], Unwatch), "the tuner is not read any more"


def test_it_belongs_to_its_owner_while_another_page_is_seen():
    async def look(app, pilot):
        await listen(app, pilot, 3.0)
        before = app.settings.signal.desk.open
        await pilot.press("f7")
        await pilot.pause()
        await listen(app, pilot, 1.0)
        return before, app.settings.signal.desk.open

    assert on_f1(look, Sources()) == (1, 0)


def test_a_simulated_receiver_beside_a_real_dish_is_called_so():
    clock = VirtualClock()
    view = View(stand_in.at_rest(clock), clock.monotonic(), clock.utc(), AppOptions())
    view = replace(view, heard=replace(RECEIVER_FACTS, demo=True))
    assert view.heard_by == "receiver"
    assert replace(view, state=replace(view.state, demo=False)).heard_by == "DEMO receiver"


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (200, 60), (60, 30)], ids=str)
def test_while_a_pass_is_followed_the_receivers_strength_is_shown(size):
    async def look(app, pilot, _desk):
        clock = app.session.clock
        for strength_db in (-52.0, -41.0, -36.1, -38.2):
            clock.advance(1.0)
            reading = SignalReading(strength_db, "dB", clock.monotonic(), clock.utc(), "rigctl")
            app.signals.book.hear(reading, RECEIVER_FACTS, app.station.state)
        app.paint()
        await pilot.pause()
        pane = app.screen.query_one(f"{type(app.page).__name__} SignalPane", SignalPane)
        return stand_in.text_of(app), pane.region.area

    text, area = track_stage.run(look, "craft-following", size, keys=("f1",))
    assert area
    assert " -38.2 dB" in text
    assert "receiver" in text
    assert "peak -36.1" in text
    assert "counts" not in text


def test_the_demos_satellite_is_heard_through_the_beam_that_follows_it():
    scenery = stage_of_the_pictures()

    async def play():
        async with scenery.demo((120, 36), tour=True) as on:
            await until(on, lambda one: one.phase is Phase.FOLLOWING and one.sample, 20.0, 0.1)
            await until(on, lambda one: len(on.app.signals.book.of(RECEIVER_FACTS)) >= 15, 30.0, 0.5)
            on.app.paint()
            await on.pilot.pause()
            return [each.value for each in on.app.signals.book.of(RECEIVER_FACTS)], on.text(), on.app.track.now.radio

    heard, text, radio = asyncio.run(play())
    assert heard[0] < -55.0  # on the way there
    followed = heard[-8:]
    assert max(followed) - min(followed) < 2.0
    assert min(followed) > -42.0
    assert " dB  peak -3" in text
    assert "receiver" in text
    assert radio.state is RadioState.TUNED
    assert radio.downlink_hz == 12.21e9
    assert radio.tuned_hz == pytest.approx(12.21e9 - 11.25e9, abs=300e3)
    assert radio.doppler_hz


def test_the_curve_of_a_dish_that_does_not_answer_is_dim():
    async def curve(app, _pilot):
        return {ink for row in app.query_one(SignalPane)._cells._inks for ink in row}

    found = stage.run_each(curve, ("idle", "lost"))
    assert "accent" in found["idle"]
    assert not {"accent", "strong"} & found["lost"]
