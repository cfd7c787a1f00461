"""The tab Track of an app that is attached: the desk is the other program's, and what it follows goes on there."""

import asyncio
import time
from datetime import UTC, datetime

import pytest
from birdcage.base.paths import Paths
from birdcage.pursuit.attached_desk import NO_DESK
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.station.attached_session import attach_session
from birdcage.station.pursuit_state import Phase
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.track_source import follow_there
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace
from stand_in import text_of

from tests.pursuit.conftest import HERE, ORBITS
from tests.pursuit.shared_desk import SharedDesk
from tests.station.attached_bench import served

SIZES = [(80, 24), (120, 36), (160, 48)]
WITHIN_S = 30.0


@pytest.fixture
def shared(tmp_path):
    port = tmp_path / "port"
    port.touch()
    now = datetime.now(UTC)  # the app goes by the machine's clock
    bench = SharedDesk(tmp_path, port=str(port), now=now, orbits=demo_orbits(now, HERE))
    bench.serve()
    yield bench
    bench.server.close()
    bench.desk.close()


def attached(port):
    session = attach_session(Paths.default(), port, "birdcage-tui")
    place = SitePlace(HERE.latitude_deg, HERE.longitude_deg, "here")
    return BirdcageApp(session, AppOptions(place=place, track=follow_there(session.station)))


async def until(pilot, seen, step=lambda: None):
    """Let time pass for the app, and by `step` for what it is attached to."""
    end = time.monotonic() + WITHIN_S
    while not seen():
        assert time.monotonic() < end, text_of(pilot.app)
        step()
        await pilot.pause(0.01)
        pilot.app.paint()
    await pilot.pause()


@pytest.mark.parametrize("size", SIZES)
def test_a_target_is_searched_chosen_and_followed_over_there_and_goes_on_without_the_app(shared, size):
    def step():
        shared.do(0.3)

    def little():
        shared.step(0.02)  # the pass is soon over

    async def follow():
        app = attached(shared.port)
        async with app.run_test(size=size) as pilot:
            await until(pilot, lambda: app.track.now is not None and app.station.is_attached, step)
            await pilot.press("2", "c", "/", *ORBITS[0].name.lower().replace(" ", ""))
            await until(pilot, lambda: app.track.now.found, step)
            await pilot.press("enter")
            await until(pilot, lambda: app.track.now.plan is not None, step)
            assert ORBITS[0].name in text_of(app)
            await pilot.press("f")
            await until(pilot, lambda: "Enter follows" in text_of(app), step)
            await pilot.press("enter")
            await until(pilot, lambda: app.station.state.pursuit is not None, step)
        return app.session.close()

    said = asyncio.run(follow())
    assert f"the dish is to follow {ORBITS[0].name}." in said or f"the dish follows {ORBITS[0].name}." in said
    shared.until(lambda: shared.phase() is Phase.FOLLOWING, 3600.0)

    async def see():
        app = attached(shared.port)
        async with app.run_test(size=size) as pilot:
            await until(pilot, lambda: "FOLLOW" in text_of(app).splitlines()[0], little)
            await pilot.press("2", "c")
            await until(pilot, lambda: f"FOLLOWING {ORBITS[0].name.removeprefix('DEMO ')}" in text_of(app), little)
            await pilot.press("space")
            await until(pilot, lambda: app.station.state.held is not None, little)
        app.session.close()

    asyncio.run(see())
    shared.until(lambda: shared.phase() is Phase.OVER)


@pytest.mark.parametrize("size", SIZES)
def test_a_program_without_a_desk_follows_nothing_and_the_tab_says_so(tmp_path, size):
    async def look(owner):
        app = attached(owner.state.port)
        async with app.run_test(size=size) as pilot:
            await pilot.press("2", "c")
            await until(pilot, lambda: app.track.now is not None and app.track.now.problem == NO_DESK)
            await pilot.pause()
            assert NO_DESK.partition(":")[0] in text_of(app).splitlines()[3]
            await pilot.press("f")
            await until(pilot, lambda: app.feeds.notes.last == NO_DESK)
        app.session.close()

    with served(tmp_path) as owner:
        asyncio.run(look(owner))
