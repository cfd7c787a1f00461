"""Pages, tour, watching, palette and help."""

from dataclasses import replace

import pytest
import stand_in
import track_stand_in
from birdcage.base.held import HeldReason
from birdcage.station.events import PositionRead, ReadingRead
from birdcage.station.requests import AcceptLimits, Home, Jog, Unwatch, Watch
from birdcage.station.state import HeldState
from birdcage_tui.commands import COMMANDS, PAGES, in_force
from birdcage_tui.shell.frame_pacer import FRESH_S, LISTEN_S
from birdcage_tui.widgets.messages import StationEvent
from stage import run
from textual.widgets import ContentSwitcher, Input


@pytest.mark.parametrize(
    ("number", "name"),
    [(number, name) for number, (name, _, _) in enumerate(PAGES, 1) if name != "console"],  # it lies over a page
)
def test_digits_and_function_keys_show_pages(number, name):
    async def visit(app, pilot):
        for key in (f"f{number}", "f1" if number > 1 else "f2", str(number % 10)):
            await pilot.press(key)
            await pilot.pause()
            await pilot.pause()
        return app.query_one("#pages", ContentSwitcher).current, app.focused

    shown, focused = run(visit)
    assert shown == f"page-{name}"
    assert not isinstance(focused, Input)


def test_the_session_starts_once_and_after_the_first_frame():
    async def count(app, pilot):
        return app.session.started

    app = stand_in.app_in("idle")
    assert app.session.started == 0
    assert run(count) == 1


def test_the_dashboard_is_watched_only_while_it_is_seen():
    async def visit(app, pilot):
        for key in ("2", "1"):
            await pilot.press(key)
            await pilot.pause()
            await pilot.pause()
        return [r for r in app.station.asked if isinstance(r, Watch | Unwatch)]

    signal, first, quiet, away, plain, signal_again, left, again = run(visit)
    assert signal.features == {"rssi"}, "the source of the signal is the tuner"
    assert first.watcher == "page-dashboard"
    assert first.features == {"position", "health"}
    assert quiet == Unwatch(signal.watcher)
    assert isinstance(away, Unwatch)
    assert "position" in plain.features, "the status line shows the position on every page"
    assert isinstance(left, Unwatch)
    assert (signal_again, again) == (signal, first)


def test_events_from_the_station_are_drawn():
    async def hear(app, pilot):
        clock = app.session.clock
        state = app.station.state
        app.station.state = replace(state, position=replace(state.position, az_deg=12.34))
        position = app.station.state.position
        for listener in app.station.listeners:
            listener(PositionRead(clock.monotonic(), clock.utc(), position))
            listener(ReadingRead(clock.monotonic(), clock.utc(), "rssi", 777.0, "counts"))
        await pilot.pause(0.2)
        return stand_in.text_of(app)

    text = run(hear)
    assert "AZ  12.34°" in text
    assert "777 counts" in text


def test_only_telemetry_may_be_replaced_in_the_queue():
    clock = stand_in.VirtualClock()
    position = stand_in.at_rest(clock).position
    one = StationEvent(PositionRead(1.0, clock.utc(), position))
    other = StationEvent(PositionRead(2.0, clock.utc(), position))
    reading = StationEvent(ReadingRead(2.0, clock.utc(), "rssi", 1.0, "counts"))
    assert other.can_replace(one)
    assert not reading.can_replace(one)
    assert not reading.can_replace(reading)


def ready(app):
    """Let the dish be surveyed, and the desk know a pass."""
    app.station.state = replace(app.station.state, surveyed=True)
    app.track._make = track_stand_in.Source(track_stand_in.desk())
    app.track.begin()
    app.session.clock.advance(1.0)


def switched(app):
    """What autotrack was told."""
    return [each for each in app.track.source.asked if each[0] == "set_autotrack"]


def test_the_demo_follows_by_itself_as_soon_as_the_dish_is_ready_and_once():
    async def tour(app, pilot):
        app._tick()
        ready(app)
        await pilot.pause()
        for _ in range(5):
            app._tick()
        return switched(app)

    assert run(tour, tour=True) == [("set_autotrack", True)]
    assert run(tour) == [], "and nothing else does"


def test_the_demo_says_that_it_moves_by_itself():
    async def tour(app, pilot):
        ready(app)
        await pilot.pause()
        app._tick()
        app.track.now = replace(app.track.now, autotrack=True)
        app._tick()
        app.paint()
        await pilot.pause()
        assert app.view().may_move
        return stand_in.text_of(app)

    assert "Demo: tracks pass after pass. Space stops" in run(tour, tour=True).splitlines()[1]


@pytest.mark.parametrize("key", ["space", "escape", "left"])
def test_stop_or_a_step_by_hand_ends_the_demo_before_it_has_begun(key):
    async def tour(app, pilot):
        await pilot.press(key)
        ready(app)
        await pilot.pause()
        app._tick()
        app._tick()
        assert app.station.stops == (["you"] if key != "left" else [])
        return switched(app)

    assert run(tour, tour=True) == []


def test_looking_around_does_not_end_the_demo():
    async def tour(app, pilot):
        await pilot.press("7", "1")
        ready(app)
        await pilot.pause()
        app._tick()
        return switched(app)

    assert run(tour, tour=True) == [("set_autotrack", True)]


@pytest.mark.parametrize("name", ["held", "lost", "not-homed", "silent", "fault"])
def test_the_demo_does_not_begin_on_a_bad_day(name):
    async def tour(app, pilot):
        ready(app)
        await pilot.pause()
        for _ in range(5):
            app._tick()
        return switched(app)

    assert run(tour, name, tour=True) == []


def test_a_hold_ends_the_demo():
    async def tour(app, pilot):
        state, clock = app.station.state, app.session.clock
        app.station.state = replace(state, held=HeldState("birdcage stop", 0.0, clock.utc(), HeldReason.STOP))
        app._tick()
        app.station.state = replace(app.station.state, held=None)
        ready(app)
        await pilot.pause()
        app._tick()
        return switched(app)

    assert run(tour, tour=True) == []


def help_of(app):
    """All lines of the help that lies on top, scrolled away or not."""
    rows = app.screen.query_one("OptionList")
    lines = [str(rows.get_option_at_index(index).prompt) for index in range(rows.option_count)]
    return "\n".join(lines) + stand_in.text_of(app)


def test_help_and_palette_come_from_the_table():
    async def read(app, pilot):
        await pilot.press("question_mark")
        await pilot.pause()
        text = help_of(app)
        await pilot.press("escape", "colon")
        await pilot.pause(0.5)
        options = app.screen.query_one("CommandList")
        return text, options.option_count

    text, count = run(read, size=(160, 60))
    here = in_force(["dashboard"])
    for command in here:
        assert command.title in text
        assert command.help in " ".join(text.split())
    assert "Ctrl+C" in text
    assert count == len(COMMANDS)


def test_what_cannot_be_done_says_why():
    async def read(app, pilot):
        await pilot.press("question_mark")
        await pilot.pause()
        return help_of(app)

    assert "Not now: STOP is latched" in " ".join(run(read, "held").split())


def test_every_footer_key_is_a_mouse_target():
    async def click(app, pilot):
        app.paint()
        bar = app.query_one("KeyBar")
        spot = next(region for region, name in bar.hot if name == "help")
        await pilot.click("KeyBar", offset=(spot.x + 1, 0))
        await pilot.pause()
        return len(app.screen_stack)

    assert run(click) == 2


def test_arrows_step_one_degree_from_the_target():
    async def step(app, pilot):
        await pilot.press("left", "up")
        return app.station.asked_for(Jog)

    assert run(step) == [Jog(-1.0, 0.0, "you"), Jog(0.0, 1.0, "you")]


@pytest.mark.parametrize(("key", "asked"), [("y", [Home("you")]), ("enter", []), ("escape", [])])
def test_homing_is_asked_for_once_in_words(key, asked):
    async def home(app, pilot):
        await pilot.press("H")
        await pilot.pause()
        text = " ".join(stand_in.text_of(app).replace("│", " ").split())
        assert "runs into its end stops" in text
        assert "12 V switch" in text
        await pilot.press(key)
        await pilot.pause()
        return app.station.asked_for(Home)

    assert run(home, "not-homed") == asked


def test_a_failed_request_is_told_in_its_own_words():
    async def fail(app, pilot):
        futures = []
        submit = app.station.submit

        def failing(request):
            future = submit(request)
            if isinstance(request, Jog):
                futures.append(future)
            return future

        app.station.submit = failing
        await pilot.press("left")
        futures[0].set_exception(ValueError("Elevation 17.0 is 1.0 below the floor."))
        await pilot.pause(0.2)
        return stand_in.text_of(app)

    assert "1.0 below the floor" in run(fail)


def test_frames_run_only_while_something_moves():
    async def frames(app, pilot):
        app.paint()
        at_rest = app.frames._beat._active.is_set()
        app.station.state = stand_in.slewing(app.session.clock)
        app.paint()
        return at_rest, app.frames._beat._active.is_set()

    assert run(frames) == (False, True)


def test_a_dead_station_thread_is_told():
    async def crash(app, pilot):
        app.session.crash = RuntimeError("torn")
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(crash)
    assert "✖ BIRDCAGE FAILED  RuntimeError: torn" in text
    assert "12 V switch" in text


@pytest.mark.parametrize(("key", "asked"), [("y", [AcceptLimits("you")]), ("enter", []), ("escape", [])])
def test_the_dishs_own_limits_are_accepted_by_name_only(key, asked):
    async def accept(app, pilot):
        await pilot.press("enter")
        await pilot.pause()
        text = stand_in.text_of(app)
        assert "birdcage.toml line 7" in text
        assert "a wall or a low roof does not stop a motion" in text
        await pilot.press(key)
        await pilot.pause()
        return app.station.asked_for(AcceptLimits)

    assert run(accept, "refused") == asked


@pytest.mark.parametrize("page", [None, "2"])
def test_a_dish_that_owes_an_answer_is_told_within_2_s_on_every_page(page):
    async def wait(app, pilot):
        if page is not None:
            await pilot.press(page)
            await pilot.pause()
        app.session.clock.advance(1.8)
        await pilot.pause(LISTEN_S + 0.1)
        return stand_in.text_of(app).splitlines()[:2]

    row_1, row_2 = run(wait)
    assert "G2 ▲ 2.0s" in row_1
    assert "▲ NO REPLY" in row_2


@pytest.mark.parametrize("key", ["question_mark", "H"])
def test_row_1_and_its_stop_stay_alive_under_a_dialog(key):
    async def dialog(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        app.session.clock.advance(5.0)
        app.paint()
        await pilot.pause()
        first = stand_in.text_of(app).splitlines()[0]
        await pilot.click("StopButton")
        return first, app.station.stops

    first, stops = run(dialog)
    assert "AZ 189.16°" in first
    assert "12:00:05Z" in first
    assert stops == ["you"]


@pytest.mark.parametrize(("age_s", "drawn"), [(FRESH_S / 2, 0), (FRESH_S * 2, 1)])
def test_a_second_draws_only_where_the_dish_has_not_made_for_a_frame(age_s, drawn, monkeypatch):
    async def rest(app, pilot):
        await pilot.pause()
        frames = []
        monkeypatch.setattr(app.frames, "changed", lambda: frames.append(1))
        app.frames._painted = app.frames.now_s() - age_s
        app.frames._second()
        assert len(frames) == drawn

    run(rest, "idle")
