"""The signal strip: who is listened to, what is said of it, and the demo's satellites heard through its own beam."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from datetime import timedelta

import pytest
import stage
import stand_in
import track_stage
from birdcage.base.clock import VirtualClock
from birdcage.radio.now import RadioNow, RadioState
from birdcage.station.events import ReadingRead
from birdcage.station.pursuit import Phase
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.signal_book import SignalBook
from test_demo import stage_of_the_pictures, until
from track_stand_in import TUNED, desk


class Book:
    """A book, and the time."""

    def __init__(self):
        self.clock = VirtualClock()
        self.state = stand_in.at_rest(self.clock)
        self.book = SignalBook()

    def tuner(self, counts):
        self.clock.advance(1.0)
        event = ReadingRead(self.clock.monotonic(), self.clock.utc(), "rssi", counts, "counts")
        self.book.hear(event, self.state)

    def receiver(self, strength_db, **more):
        """Show the receiver with a strength that was read now."""
        self.clock.advance(1.0)
        self.show(replace(TUNED, strength_db=strength_db, strength_at=self.clock.utc(), **more))

    def show(self, radio):
        self.book.tell(desk(radio=radio), self.clock.monotonic(), self.state)

    @property
    def told(self):
        return self.book.heard.by, self.book.heard.unit, [each.value for each in self.book.samples]


def test_the_tuner_counts_until_a_receiver_tells_and_again_after_it():
    here = Book()
    here.tuner(500.0)
    here.show(RadioNow())
    assert here.told == ("tuner", "counts", [500.0])
    here.receiver(-50.0)
    here.receiver(-40.0)
    here.tuner(510.0)
    assert here.told == ("receiver", "dB", [-50.0, -40.0])
    here.show(RadioNow(RadioState.OFF))
    assert here.told == ("tuner", "counts", [500.0, 510.0])


def test_a_receiver_that_is_lost_leaves_what_it_told_while_the_tuner_tells_nothing():
    here = Book()
    here.tuner(500.0)
    here.receiver(-40.0)
    here.show(RadioNow(RadioState.LOST))
    assert here.told == ("receiver", "dB", [-40.0])
    here.tuner(501.0)
    assert here.told[0] == "tuner"


def test_a_strength_counts_once_however_often_it_is_shown():
    here = Book()
    here.receiver(-40.0)
    read_at = here.clock.utc()
    for _ in range(5):
        here.clock.advance(0.1)
        here.show(replace(TUNED, strength_db=-40.0, strength_at=read_at, doppler_hz=here.clock.monotonic()))
    assert here.told == ("receiver", "dB", [-40.0])
    here.show(replace(TUNED, strength_db=-40.0, strength_at=read_at + timedelta(seconds=1)))
    assert here.told == ("receiver", "dB", [-40.0, -40.0])


def test_where_it_was_heard_is_kept_and_not_guessed():
    here = Book()
    here.receiver(-40.0)
    here.state = replace(here.state, position=None)
    here.receiver(-41.0)
    known, unknown = here.book.samples
    assert (known.az_deg, known.el_deg) == (stand_in.at_rest(here.clock).position.az_deg, 42.87)
    assert (unknown.az_deg, unknown.el_deg) == (None, None)


@pytest.mark.parametrize(("demo", "by"), [(True, "receiver"), (False, "DEMO receiver")])
def test_a_simulated_receiver_beside_a_real_dish_is_called_so(demo, by):
    here = Book()
    here.state = replace(here.state, demo=demo)
    here.receiver(-40.0, address="sim:rig")
    assert here.told[0] == by


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (200, 60), (60, 30)], ids=str)
def test_while_a_pass_is_followed_the_receivers_strength_is_shown(size):
    async def look(app, pilot, _desk):
        clock = app.session.clock
        for second, strength_db in enumerate((-52.0, -41.0, -36.1, -38.2)):
            clock.advance(1.0)
            radio = replace(TUNED, strength_db=strength_db, strength_at=clock.utc())
            app.signals.tell(desk(radio=radio), clock.monotonic(), app.station.state)
            assert second < 4
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
            await until(on, lambda one: len(on.app.signals.receiver) >= 15, 30.0, 0.5)
            on.app.paint()
            await on.pilot.pause()
            return [each.value for each in on.app.signals.receiver], on.text(), on.app.track.now.radio

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
