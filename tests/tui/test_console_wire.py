"""The console on a real station and a simulated dish: bytes out, answers in, and who may speak."""

import asyncio
import functools

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.paths import Paths
from birdcage.station.build import open_session
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import AcquireLease
from birdcage_tui.console.entry import ConsoleInput
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace
from stand_in import text_of


class Desk:
    """The app, its console open, on a station that is stepped."""

    def __init__(self, folder, port="sim:g2?seed=1"):
        self.clock, self.wire = VirtualClock(), []
        paths = Paths.in_folder(folder)
        self.session = open_session(
            port=port, firmware="g2", baud=None, settings=Settings(), paths=paths, clock=self.clock, survey=False
        )
        self.session.start = lambda: None
        self.station = self.session.station
        settings = AppOptions(place=SitePlace(39.1, -95.7), history_file=paths.history, logs_folder=paths.logs)
        self.app = BirdcageApp(self.session, settings)

    async def begin(self, pilot):
        self.pilot = pilot
        await self.step(3)
        self.session.on_wire(self.wire.append)
        await self.press("f5")
        await self.pilot.pause()
        await self.press("i")
        await self.step(1)

    async def step(self, seconds):
        piece_s = 0.1 if seconds < 0.5 else 0.5 if seconds < 5 else 1.0
        for _ in range(max(1, round(seconds / piece_s))):
            self.session.step(piece_s)
            await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()

    async def press(self, *keys):
        await self.pilot.press(*keys)
        await self.pilot.pause()

    async def send(self, line, seconds=1.0):
        self.app.query_one(ConsoleInput).value = line
        await self.press("enter")
        await self.step(seconds)

    @property
    def line(self):
        return self.app.query_one(ConsoleInput).value

    def text(self):
        return text_of(self.app)

    def words(self):
        return " ".join(self.text().replace("│", " ").split())

    def went_out(self, since=0):
        return [each.data for each in self.wire[since:] if each.direction == ">"]


@pytest.fixture
def at(tmp_path):
    desk = Desk(tmp_path)
    yield desk
    desk.session.close()


def talked(test):
    """Make a plain test of a coroutine that begins with the console open and the line in focus."""

    @functools.wraps(test)
    def run(at):
        async def body():
            async with at.app.run_test(size=(120, 48)) as pilot:
                await at.begin(pilot)
                await test(at)

        asyncio.run(body())

    return run


@talked
async def test_submenus_work_while_the_page_above_watches(at):
    assert "WATCH" in at.text()
    for line in ("q", "dvb", "rssi 5", "q", "mot", "a"):
        since = len(at.wire)
        await at.send(line, 2.0)
        assert at.line == ""
        # A mark of blanks and a bare CR before a `q` prove the submenu.
        assert [data for data in at.went_out(since) if data.strip()] == [line.encode() + b"\r"], line
    text = at.text()
    assert "TALK" in text
    assert "Reads:5 RSSI[avg:" in text
    assert "Invalid" not in text
    assert "< Angle[1] = 45.00" in text
    assert at.station.state.holder == CONSOLE


@talked
async def test_a_motion_beyond_the_limit_warns_and_is_marked_when_sent(at):
    await at.press(*"a", "space", "0", "space", *"9999")
    await at.step(0.1)
    assert "Azimuth 9999.00° is 9639.00° beyond the limit of 360.00°" in at.words()
    assert "▲ MOVES an axis at once. Enter asks first." in at.words()
    assert "checks no limits" not in at.words(), "the limit that is told refutes it"
    since = len(at.wire)
    await at.press("enter")
    await at.step(0.5)
    assert b"a 0 9999\r" not in at.went_out(since)
    assert "Send a 0 9999" in at.words()
    assert "checks no limits" not in at.words()
    await at.press("y")
    await at.step(0.5)
    assert b"a 0 9999\r" in at.went_out(since)
    assert "# raw by console: a 0 9999 (MOVES" in at.text()


@talked
async def test_escape_stops_what_a_raw_line_set_in_motion(at):
    await at.send("a 0 200", 0.4)
    await at.press("y")
    await at.step(0.3)
    assert at.app.view_may_move()
    assert "Esc or Ctrl+C stops the dish" in at.words()
    await at.press("escape")
    await at.step(3)
    assert at.station.state.held is not None
    assert at.app.stage.sheet.is_open


@talked
async def test_escape_is_no_stop_while_somebody_only_talks(at):
    await at.send("a")
    assert at.station.state.holder == CONSOLE
    await at.press("escape", "escape")
    await at.step(2)
    assert at.station.state.held is None
    assert not at.app.stage.sheet.is_open
    assert at.station.state.holder is None


@talked
async def test_thirty_idle_seconds_give_control_back_and_the_station_looks(at):
    await at.send("a")
    assert "30 s idle returns control" in at.words() or "29 s idle returns control" in at.words()
    await at.step(20)
    assert "TALK" in at.text()
    await at.step(14)
    assert "WATCH" in at.text()
    assert at.app.view().position_age_s < 2


@talked
async def test_a_stream_runs_until_enter_ends_it(at):
    for line in ("q", "dvb", "agc"):
        await at.send(line)
    assert "`agc` running" in at.text()
    since = len(at.wire)
    await at.press("enter")
    await at.step(1)
    assert set(at.went_out(since)) == {b"\r"}
    assert "running" not in at.text()


@talked
async def test_closing_in_the_middle_of_a_stream_ends_it_and_polling_goes_on(at):
    for line in ("q", "dvb", "agc"):
        await at.send(line)
    await at.press("f5")
    await at.step(4)
    assert at.station.state.holder is None
    assert at.station.state.menu == "mot"
    assert at.app.view().position_age_s < 2


@talked
async def test_another_holder_is_named_and_taken_over(at):
    at.station.submit(AcquireLease("Gpredict"))
    await at.step(0.2)
    since = len(at.wire)
    await at.send("life", 0.5)
    assert "Gpredict controls the dish" in at.words()
    assert b"life\r" not in at.went_out(since)
    await at.press("y")
    await at.step(1)
    assert at.station.state.holder == CONSOLE
    assert b"life\r" in at.went_out(since)


@talked
async def test_a_motion_while_held_is_refused_in_words_and_comes_back(at):
    at.station.stop("you")
    await at.step(1)
    since = len(at.wire)
    await at.send("r", 0.4)
    assert "# STOP is latched: `r` may move the dish and is not sent." in at.text()
    assert "To release the motors now: F5 closes the console, then F2 and R." in at.words()
    assert at.line == "r"
    assert b"r\r" not in at.went_out(since)


@talked
async def test_the_dish_lists_its_own_commands_on_tab(at):
    await at.send("a")
    since = len(at.wire)
    await at.press("tab")
    await at.step(1)
    assert b"?\r" in at.went_out(since)
    assert "The dish lists" in at.text()
