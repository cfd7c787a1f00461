"""Frames: no more than were asked for, and fewer by themselves while the terminal lags."""

import asyncio
import io

import pytest
import stand_in
from birdcage_tui.shell.stopping import stop_first
from textual.drivers._writer_thread import WriterThread
from textual.drivers.headless_driver import HeadlessDriver


def run(look, **settings):
    async def main():
        app = stand_in.app_in("slewing", **settings)
        async with app.run_test(size=(80, 24)) as pilot:
            await pilot.pause()
            app.frames._beat.stop()
            if app.frames._soon is not None:
                app.frames._soon.stop()
                app.frames._soon = None
            return look(app)

    return asyncio.run(main())


def painted_in(app, seconds, *, step_s=0.01):
    """Let something ask for a frame all the time, on a clock of our own; return how many were drawn."""
    frames = []
    app.frames._painted, app.now_s = 0.0, 0.0
    app.frames.now_s = lambda: app.now_s
    app.set_timer = lambda *_: None  # the next call asks again

    def paint():
        frames.append(app.now_s)
        app.frames._painted = app.now_s

    app.frames._paint = paint
    for _ in range(round(seconds / step_s)):
        app.now_s += step_s
        app.frames._soon = None
        app.frames.changed()
    return len(frames)


@pytest.mark.parametrize(("update_hz", "least", "most"), [(10.0, 18, 20), (2.0, 3, 4), (30.0, 48, 60)])
def test_frames_are_no_more_than_the_setting_allows(update_hz, least, most):
    assert least <= run(lambda app: painted_in(app, 2.0), update_hz=update_hz) <= most


def test_the_beat_of_a_motion_is_the_setting_too():
    assert run(lambda app: app.frames._beat._interval, update_hz=4.0) == 0.25


def test_no_frame_is_drawn_while_one_waits_to_be_written():
    def lag(app):
        app._driver.unwritten = 1
        behind = painted_in(app, 2.0)
        app._tick()
        app._driver.unwritten = 0
        return behind, painted_in(app, 2.0)

    behind, after = run(lag)
    assert behind == 0
    assert after >= 18


def test_what_waits_to_be_written_is_counted_where_textual_keeps_it():
    driver = stop_first(HeadlessDriver).__new__(stop_first(HeadlessDriver))
    assert driver.unwritten == 0
    driver._writer_thread = WriterThread(io.StringIO())  # not started: a terminal that takes nothing
    driver._writer_thread.write("one frame")
    driver._writer_thread.write("another")
    assert driver.unwritten == 2
