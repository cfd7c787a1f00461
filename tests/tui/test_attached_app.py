"""The app over the station of another program: what it says of that, what stops the dish, and its end."""

import asyncio
import time
from dataclasses import fields
from datetime import timedelta

import pytest
import stand_in
from birdcage.base.paths import Paths
from birdcage.station.attached_session import attach_session
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.requests import Goto, Watch
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage_tui import main
from birdcage_tui import run as run_app
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from stand_in import text_of

from tests.station.attached_bench import served
from tests.station.pursuit_bench import plan_of

SIZES = [(80, 24), (120, 36), (160, 48)]


@pytest.fixture
def owner(tmp_path):
    with served(tmp_path) as owner:
        show(owner, "idle")
        yield owner


def show(owner, name, **more):
    """Let the station be in one of the states to show."""
    state = stand_in.STATES[name](owner.clock)
    told = {field.name: getattr(state, field.name) for field in fields(state)}
    owner.board.change(**{**told, "demo": False, "port": owner.state.port, **more})


def run(owner, test, size=(80, 24), **options):
    async def body():
        session = attach_session(Paths.default(), owner.state.port, "birdcage-tui")
        app = BirdcageApp(session, AppOptions(place=stand_in.PLACE, **options))
        async with app.run_test(size=size) as pilot:
            await until(pilot, lambda: app.station.is_attached and app.station.state.position is not None)
            app.paint()
            await pilot.pause()
            found = await test(app, pilot)
        app.said = session.close()
        return found if found is not None else app

    return asyncio.run(body())


async def until(pilot, seen, within_s=10.0):
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, text_of(pilot.app)
        await pilot.pause()
        time.sleep(0.01)
    pilot.app.paint()
    await pilot.pause()


@pytest.mark.parametrize("size", SIZES)
def test_it_shows_that_it_is_attached_and_to_whom(owner, size):
    async def look(app, pilot):
        owner.board.change(port="/dev/ttyUSB0")  # the path of the test's own file is longer than any port's
        await until(pilot, lambda: app.station.state.port == "/dev/ttyUSB0")
        rows = text_of(app).splitlines()
        assert " ATTACHED " in rows[0]
        assert "AZ 189.16°" in rows[0]
        assert rows[1].strip().startswith(f"attached to birdcage (process {owner.found.pid})")
        if size[0] >= 160:
            assert "/dev/ttyUSB0 via birdcage " in rows[0]

    run(owner, look, size)


@pytest.mark.parametrize("size", SIZES)
def test_an_app_of_its_own_shows_nothing_of_that(size):
    async def look():
        app = stand_in.app_in("idle")
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return text_of(app)

    assert "ATTACHED" not in asyncio.run(look())


@pytest.mark.parametrize("key", ["space", "ctrl+c", "escape"])
def test_stop_goes_to_the_program_that_has_the_port(owner, key):
    show(owner, "slewing")

    async def press(app, pilot):
        await until(pilot, lambda: app.station.state.motion is not None)
        await pilot.press(key)
        await until(pilot, lambda: owner.stops)

    run(owner, press)
    assert len(owner.stops) == 1


def test_its_end_stops_nothing_there_and_says_what_goes_on(owner):
    show(owner, "slewing")

    async def leave(app, pilot):
        await until(pilot, lambda: app.station.state.motion is not None)
        await pilot.press("ctrl+q")
        await pilot.pause(0.1)
        assert not app.is_running

    app = run(owner, leave)
    assert owner.stops == []
    assert app.return_code == 0
    assert f"birdcage (process {owner.found.pid}) goes on: the dish moves to AZ 160.70" in app.said


@pytest.mark.parametrize(("number", "stops"), [(1, 0), (15, 0), (2, 1)])
def test_a_signal_ends_it_and_only_a_persons_interrupt_stops_the_dish(owner, number, stops):
    show(owner, "slewing")

    async def end(app, pilot):
        await until(pilot, lambda: app.station.state.motion is not None)
        app.ending.by_signal(number)
        await pilot.pause(0.1)
        assert not app.is_running
        assert app.return_code == 128 + number

    run(owner, end)
    end_s = time.monotonic() + 5
    while len(owner.stops) < stops and time.monotonic() < end_s:
        time.sleep(0.01)
    assert len(owner.stops) == stops


def test_what_is_asked_here_comes_under_a_name_of_its_own(owner):
    async def go(app, pilot):
        await pilot.press("g")
        await pilot.press(*"200 45", "enter")
        await until(pilot, lambda: [each for each in owner.asked if isinstance(each, Goto)])

    run(owner, go)
    asked = next(each for each in owner.asked if isinstance(each, Goto))
    assert (asked.az_deg, asked.el_deg) == (200.0, 45.0)
    assert asked.holder != "you"


@pytest.mark.parametrize("size", SIZES)
def test_a_program_that_is_gone_is_shown_at_once_and_the_next_one_is_attached_to(owner, size):
    async def lose(app, pilot):
        owner.server.close()
        await until(pilot, lambda: app.station.state.link.state is LinkPhase.LOST)
        rows = text_of(app).splitlines()
        assert " LOST " in rows[0]
        assert " DETACHED " in rows[0]
        assert "LINK LOST" in rows[1]
        await pilot.press("space")
        await until(pilot, lambda: app.station.state.last_stop is not None)
        words = " ".join(text_of(app).split())
        assert "✖ STOP DID NOT GET THROUGH No birdcage program drives" in words
        assert "If the dish moves, cut its power. `birdcage stop` opens the port itself." in words
        before = len(owner.asked)
        owner.serve_again()
        await until(pilot, lambda: app.station.is_attached)
        await until(pilot, lambda: any(isinstance(each, Watch) for each in owner.asked[before:]))
        rows = text_of(app).splitlines()
        assert "IDLE" in rows[0]
        assert " ATTACHED " in rows[0]
        assert "DID NOT GET THROUGH" not in rows[1]

    run(owner, lose, size)
    assert owner.stops == []


@pytest.mark.parametrize("state", ["idle", "held"])
@pytest.mark.parametrize("size", SIZES)
def test_a_program_that_is_frozen_is_told_of_once_stop_has_no_answer(owner, size, state):
    show(owner, state, last_stop=None)

    async def freeze(app, pilot):
        owner.thawed.clear()
        await pilot.press("space")
        await until(pilot, lambda: app.station.state.last_stop is not None)
        words = " ".join(text_of(app).split())
        assert f"DID NOT GET THROUGH birdcage (process {owner.found.pid}) does not answer." in words
        assert "It is unknown whether STOP was sent. If the dish moves, cut its power. Then end that process." in words
        owner.thawed.set()

    run(owner, freeze, size)


@pytest.mark.parametrize("size", SIZES)
def test_the_console_hears_the_wire_of_the_other_program_from_its_first_opening(owner, size):
    owner.board.change(menu="mot")

    async def listen(app, pilot):
        assert not owner.transcript._listeners
        await pilot.press("5")
        await until(pilot, lambda: owner.transcript._listeners)
        owner.pass_on_wire(">", b"help\r")
        owner.pass_on_wire("<", b"help\r\nunheard of\r\nMOT> ")
        await until(pilot, lambda: "unheard of" in text_of(app))
        await pilot.press("i", *"a 0 100")
        await until(pilot, lambda: "MOVES" in text_of(app))
        assert "MOT>" in text_of(app)

    run(owner, listen, size)


def following(owner, phase=Phase.FOLLOWING):
    """Let the station follow a pass for somebody else."""
    plan = plan_of(owner.clock.utc().timestamp() - 10.0)
    pursuit = Pursuit(1, "tracker", plan, PursuitOptions(), phase, owner.clock.monotonic(), "")
    owner.board.change(pursuit=pursuit, activity=Activity.FOLLOWING, holder="tracker")


@pytest.mark.parametrize("size", [*SIZES, (40, 12)])
def test_a_pass_that_is_followed_there_is_told_on_every_page_that_shows_one(owner, size):
    following(owner)

    async def look(app, pilot):
        await until(pilot, lambda: app.station.state.activity is Activity.FOLLOWING)
        assert "FOLLOW" in text_of(app)
        for keys in (["2", "c"], ["N"], ["7"], ["1"]) if size[0] >= 80 else ():
            await pilot.press(*keys)
            await pilot.pause()
            app.paint()
            await pilot.pause()
            assert "tracker"[:6] in text_of(app).splitlines()[0]
        await pilot.press("escape")  # the dish moves, so it stops first
        await until(pilot, lambda: owner.stops)

    app = run(owner, look, size)
    assert "goes on: the dish follows NOAA 19." in app.said


@pytest.mark.parametrize("size", SIZES)
def test_what_counts_down_there_is_told_here(owner, size):
    following(owner, Phase.COUNTDOWN)
    soon = owner.clock.utc() + timedelta(seconds=4)
    task = TaskState(1, "pursuit", "tracker", TaskPhase.COUNTDOWN, owner.clock.monotonic(), "", next_at=soon)
    owner.board.change(tasks=(task,), activity=Activity.IDLE)

    async def look(app, pilot):
        await until(pilot, lambda: app.station.state.tasks)
        assert "▲ MOVES to 100°/30° for NOAA 19" in text_of(app).splitlines()[1]
        assert "Space cancels" in text_of(app).splitlines()[1]

    run(owner, look, size)


@pytest.mark.parametrize("size", SIZES)
def test_the_server_for_other_programs_is_elsewhere(owner, size):
    async def look(app, pilot):
        await pilot.press("2", "N")
        await pilot.pause()
        await pilot.press("o")
        await pilot.pause()
        assert "birdcage serve" in app.feeds.notes.last

        def is_read():
            show(owner, "idle")  # a dish that is late with its answer takes the row
            app.paint()
            return "birdcage serve" in text_of(app)

        await until(pilot, is_read)

    run(owner, look, size)


def options(**given):
    """What `birdcage-tui` was started with, as `main` reads it."""
    return main.parser().parse_args([word for name, value in given.items() for word in (f"--{name}", value) if word])


def test_without_a_named_port_it_attaches_to_the_only_program_that_has_one(owner):
    session, settings, _services = run_app._build(options(baud="9600"), Paths.default())
    try:
        assert session.via.startswith("birdcage (process")
        assert settings.first_page == "dashboard"
        assert settings.network is None
        assert settings.notice.startswith("▲ --baud: without effect here.")
    finally:
        session.close()


def test_with_another_port_it_opens_that_itself(owner, tmp_path):
    session, settings, _services = run_app._build(
        options(port=str(tmp_path / "elsewhere"), firmware="g2"), Paths.default()
    )
    assert session.via == ""
    assert settings.network is not None
    assert settings.notice == ""
