"""F3: the numbers that count with both hands on the dish, in the demo and beside a dish that has no tuner."""

from __future__ import annotations

import asyncio
import itertools
import re
from types import SimpleNamespace

import pytest
import stage
import stand_in
from birdcage.signal.beam_fit import BeamFit
from birdcage.signal.peak_hold import HeardPeak, LevelNow, Trend
from birdcage.station.requests import BeginTask, Goto, Jog, Watch
from birdcage.station.state import Activity
from birdcage_tui.control.jog import JogPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.level_words import turn_to
from birdcage_tui.shown.tone_words import bell_period_s
from birdcage_tui.signal.head import SignalHead
from birdcage_tui.signal.level import LevelPane
from birdcage_tui.signal.receiver import ReceiverPane
from birdcage_tui.signal.to_peak import ToPeakPane
from test_demo import stage_of_the_pictures

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]
PANES = (SignalHead, LevelPane, ToPeakPane, JogPane, SignalPane, ReceiverPane)


def level(app, *, share=0.98, trend=Trend.SAME, az_deg=190.0, el_deg=42.0, late_s=0.1, fit=None):
    """Have the app show this level."""
    now = app.session.clock.monotonic()
    peak = HeardPeak(445.0, now - 12.0, az_deg, el_deg)
    told = LevelNow(443.0, now - late_s, 8.2, 0.65, 401.0, peak, share, trend, fit)
    app.signals.book._holds[app.signals.book.heard.id] = type("Hold", (), {"now": lambda _self: told})()


def shown(size=(120, 36), name="idle", **what):
    async def look(app, pilot):
        level(app, **what)
        app.paint()
        await pilot.pause()
        return stage.stand_in.text_of(app)

    return stage.run(look, name, size, key="f3")


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "slewing", "lost", "travler-slew"])
def test_all_of_it_can_be_seen_and_reached(size, name):
    async def regions(app, _pilot):
        page = app.query_one("#page-signal")
        return {kind.__name__: page.query_one(kind).region for kind in PANES}, app.screen.region

    found, screen = stage.run(regions, name, size, key="f3")
    for what, region in found.items():
        assert region.area > 0, what
        assert screen.contains_region(region), (what, region)
    for (what, region), (other, second) in itertools.combinations(found.items(), 2):
        assert not region.overlaps(second), (what, other)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_part_of_the_peak_age_and_way_stand_there_at_every_size(size):
    text = shown(size, trend=Trend.HOTTER)
    for words in ("% of the peak", "▲ hotter", "443 counts", "floor 401", "0.1s old", "azimuth", "elevation",
                  "445 counts at 190.0°/42.0°", "8.2 readings a second"):  # fmt: skip
        assert words in text, words


def test_the_rate_that_is_asked_for_stands_beside_the_one_that_is_reached_where_there_is_room():
    assert "asked 10/s, 8.2 readings a second" in shown((120, 36))
    assert "asked" not in shown((80, 24)).splitlines()[2]


def test_a_peak_that_is_only_noise_is_not_claimed():
    text = shown(share=None)
    assert "% of the peak" not in text
    assert "no peak yet" in text


def test_a_reading_that_is_late_says_how_old_it_is_and_a_peak_without_direction_shows_no_degrees():
    assert "30s old" in shown(late_s=30.0)
    assert "°/" not in shown(az_deg=None, el_deg=None).split("To the peak")[1].split("Signal")[0]


def test_arrows_step_the_dish_here_and_p_only_offers_the_way_to_the_peak():
    async def body(app, pilot):
        level(app)
        await pilot.press("right", "p")
        await pilot.pause()
        jogs, gotos = app.station.asked_for(Jog), app.station.asked_for(Goto)
        await pilot.press("enter")
        await pilot.pause()
        return jogs, gotos, app.station.asked_for(Goto)

    jogs, before, after = stage.run(body, "idle", key="f3")
    assert [jog.d_az_deg for jog in jogs] == [1.0]
    assert before == []
    assert [(goto.az_deg, goto.el_deg) for goto in after] == [(190.0, 42.0)]


def test_the_peak_is_found_only_after_a_yes_and_what_was_found_is_said():
    """The real page, the real station, the simulated dish; the wire shows that nothing moves before the answer."""
    pictures = stage_of_the_pictures()

    async def play():
        async with pictures.demo((80, 24)) as on:
            await on.wait(9)
            await on.press("f3", "g")
            await on.type("213.0 39.5")
            await on.press("enter")
            await on.wait(10)
            here = on.app.station.state.position
            await on.press("f")
            await on.wait(4)
            asked = on.text()
            await on.press("q")
            await on.wait(4)
            still, declined = on.app.station.state.position, on.app.station.state.tasks
            await on.press("f", "enter")
            await on.wait(12)
            running = on.text()
            await on.wait(50)
            return (here, still, declined), asked, running, on.text(), on.app.station.state

    (here, still, declined), asked, running, ended, state = asyncio.run(play())
    assert "25 directions, up to 3.9° to each side, then to the middle." in asked
    assert declined == ()
    assert (here.az_deg, here.el_deg) == (still.az_deg, still.el_deg)
    assert re.search(r"Finding the peak: \d+ of 25 heard", running)
    assert re.search(r"Peak at 214\.\d\d°/38\.\d\d° ±0\.\d\d°, 1\d\d over the floor\.", ended)
    assert (state.position.az_deg, state.position.el_deg) == (
        pytest.approx(214.35, abs=0.3), pytest.approx(38.73, abs=0.2),
    )  # fmt: skip
    assert state.holder is None


@pytest.mark.parametrize(("name", "words"), [
    ("travler-slew", "has no tuner to read"), ("lost", "f no answer"), ("held", "Enter release"),
])  # fmt: skip
def test_where_it_can_not_be_found_f_says_why_and_asks_nothing(name, words):
    async def body(app, pilot):
        await pilot.press("f")
        await pilot.pause()
        return app.station.asked_for(BeginTask), len(app.screen_stack), stand_in.text_of(app)

    begun, layers, text = stage.run(body, name, (120, 36), key="f3")
    assert (begun, layers) == ([], 1)
    assert words in text


def test_without_a_peak_p_says_so():
    async def body(app, pilot):
        await pilot.press("p")
        await pilot.pause()
        return app.station.asked_for(Goto), stand_in.text_of(app)

    gotos, text = stage.run(body, "idle", key="f3")
    assert gotos == []
    assert "No peak with a direction was heard yet." in text


def test_the_signal_is_read_steadily_here_and_in_bursts_on_the_dashboard():
    async def body(app, pilot):
        await pilot.press("f1")
        await pilot.pause()
        return [watch.steady for watch in app.station.asked_for(Watch) if "rssi" in watch.features]

    assert stage.run(body, "idle", key="f3") == [False, True, False]


def test_a_dish_without_a_tuner_says_what_to_do():
    async def body(app, pilot):
        await pilot.press("f3")
        await pilot.pause()
        return stand_in.text_of(app)

    text = " ".join(stage.run(body, "travler-slew", (160, 48)).split())
    assert "has no tuner to read" in text
    assert "no receiver of its own" in text


def test_in_the_demo_a_step_away_is_colder_and_the_way_back_is_found():
    """The real page, the real station, the simulated dish, which listens to its satellites."""
    pictures = stage_of_the_pictures()

    async def play():
        async with pictures.demo((120, 36)) as on:
            await on.wait(9)
            await on.press("f3", "g")
            await on.type("119W")
            await on.press("enter")
            await on.wait(10)
            await on.press("x")
            for key in ("left",) * 6:
                await on.press(key)
                await on.wait(3)
            away = on.text(), on.app.view().level
            await on.press("p", "enter")
            await on.wait(6)
            return away, (on.text(), on.app.view().level)

    (away, far), (back, near) = asyncio.run(play())
    assert "▼ colder" in away
    assert far.share < 0.2
    assert "▲ hotter" in back
    assert near.share > 0.95
    assert near.rate_hz > 4.0


@pytest.mark.parametrize(("size", "said"), [((40, 12), "98 % ▲ hotter"), ((60, 30), "98 % of peak  ▲ hotter")], ids=str)
def test_the_pocket_view_says_the_three_numbers_too(size, said):
    async def look(app, pilot):
        level(app, trend=Trend.HOTTER, az_deg=189.46)
        app.paint()
        await pilot.pause()
        level(app, late_s=30.0)
        steady = [watch.steady for watch in app.station.asked_for(Watch) if "rssi" in watch.features]
        before = stand_in.text_of(app)
        app.paint()
        await pilot.pause()
        return before, stand_in.text_of(app), steady

    fresh, late, steady = stage.run(look, "idle", size)
    assert f"443  {said}  ▶0.3° ▼0.9°" in fresh
    assert "30s old" in late
    assert steady[-1] is True


class Bell:
    """The bell, and the timers that bring the next one: they go off when the test says so."""

    def __init__(self, app, page="signal"):
        self.rung, self.timers = 0, []
        self._page = app.query_one(f"#page-{page}")
        self._page.set_timer = self._set
        app.bell = self._ring

    def _ring(self):
        self.rung += 1

    def _set(self, delay_s, call):
        timer = SimpleNamespace(delay_s=delay_s, call=call, stop=lambda: self.timers.remove(timer))
        self.timers.append(timer)
        return timer

    def go_off(self):
        timer = self.timers.pop()
        timer.call()
        return timer.delay_s


def test_the_bell_rings_faster_the_hotter_it_is_and_not_at_all_without_a_peak():
    async def body(app, pilot):
        bell, found = Bell(app), []
        level(app, share=None)
        await pilot.press("t")
        for share in (None, 0.0, 1.0):
            level(app, share=share)
            bell.go_off()
            found.append((bell.rung, round(bell.timers[0].delay_s, 2), len(bell.timers)))
        return found, stand_in.text_of(app)

    found, text = stage.run(body, "idle", key="f3")
    assert found == [(0, 0.3, 1), (1, 1.6, 1), (2, 0.16, 1)]
    assert "bell on: faster is hotter" in text


def test_the_tone_ends_with_its_key_and_on_another_page_and_comes_back_with_this_one():
    async def body(app, pilot):
        bell = Bell(app)
        level(app)
        await pilot.press("t", "f1")
        await pilot.pause()
        bell.go_off()
        elsewhere = bell.rung, len(bell.timers)
        await pilot.press("f3")
        app.paint()
        await pilot.pause()
        back = bell.rung, len(bell.timers)
        await pilot.press("t")
        app.paint()
        await pilot.pause()
        return elsewhere, back, len(bell.timers)

    assert stage.run(body, "idle", key="f3") == ((1, 0), (2, 1), 0)


@pytest.mark.parametrize(("share", "period_s"), [(0.0, 1.6), (0.5, 0.506), (1.0, 0.16), (1.3, 0.16), (-0.2, 1.6)])
def test_the_period_of_the_bell(share, period_s):
    async def body(app, _pilot):
        level(app, share=share)
        return bell_period_s(app.view())

    assert stage.run(body, "idle", key="f3") == pytest.approx(period_s, abs=0.001)


@pytest.mark.parametrize("what", [{"share": None}, {"late_s": 60.0}])
def test_there_is_silence_while_nothing_is_known(what):
    async def body(app, _pilot):
        level(app, **what)
        return bell_period_s(app.view())

    assert stage.run(body, "idle", key="f3") is None


class FakeSound:
    """Takes the pitches; has trouble when the test says so."""

    def __init__(self):
        self.played, self.closed, self.trouble = [], 0, ""

    def play(self, pitch_hz):
        self.played.append(pitch_hz)

    def close(self):
        self.closed += 1


@pytest.mark.parametrize(("size", "page"), [((120, 36), "signal"), ((40, 12), "pocket")])
def test_with_a_sound_system_the_pitch_follows_and_no_bell_rings(size, page):
    sound = FakeSound()

    async def body(app, pilot):
        bell, words = Bell(app, page), []
        level(app, share=0.0)
        await pilot.press("t")
        for what in ({"share": 1.0}, {"share": 0.5}, {"share": None}, {"late_s": 2.0}):
            level(app, **what)
            bell.go_off()
        app.paint()
        await pilot.pause()
        words.append(stand_in.text_of(app))
        sound.trouble = "aplay ended."
        level(app)
        bell.go_off()
        app.paint()
        await pilot.pause()
        words.append(stand_in.text_of(app))
        rung, waits = bell.rung, round(bell.timers[0].delay_s, 2)
        await pilot.press("t")
        return rung, waits, words

    rung, waits, words = stage.run(body, "idle", size, key="f3", sound=lambda: (sound, ""))
    assert sound.played == [pytest.approx(hz, rel=1e-3) if hz else None for hz in (220.0, 1760.0, 622.25, None, None)]
    assert (rung, waits, sound.closed) == (1, 0.17, 2), "with its key, and with the app"
    if page == "signal":
        assert "tone on: higher is hotter" in words[0]
        assert "bell on: faster is hotter" in words[1]
        assert "aplay ended. Bell on: faster is hotter." in words[1]


def test_without_a_sound_system_it_says_why():
    async def body(app, pilot):
        Bell(app)
        await pilot.press("t")
        await pilot.pause()
        return stand_in.text_of(app)

    text = stage.run(body, "idle", (120, 36), key="f3", sound=lambda: (None, "Over ssh"))
    assert "Over ssh there is no sound. Bell on: faster is hotter. t: silence." in text


FIT = BeamFit(189.46, 42.17, 0.04, 150.0, 400.0, 6.4, 12)


def test_where_a_fit_tells_the_middle_the_way_leads_there():
    text = shown(fit=FIT)
    assert "Fit of 12: 189.46°/42.17° ±0.04°" in text
    assert "445 counts at" not in text

    async def body(app, pilot):
        level(app, fit=FIT)
        await pilot.press("p", "enter")
        await pilot.pause()
        return app.station.asked_for(Goto)

    assert [(goto.az_deg, goto.el_deg) for goto in stage.run(body, "idle", key="f3")] == [(189.46, 42.17)]


def test_no_way_is_shown_while_the_dish_follows_what_moves():
    async def body(app, _pilot):
        level(app, fit=FIT)
        return turn_to(app.view().level, app.view()), app.view()

    assert stage.run(body, "idle")[0] is not None
    turn, view = stage.run(body, "idle", state={"activity": Activity.FOLLOWING})
    assert (view.state.activity, turn) == (Activity.FOLLOWING, None)
