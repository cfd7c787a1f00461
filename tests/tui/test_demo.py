"""The demo, untouched, with the real desk and station on a virtual clock: it follows, parks, waits, and goes again."""

from __future__ import annotations

import asyncio
import importlib.util
import sys
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.paths import Paths
from birdcage.sim.settings import SimSettings
from birdcage.station.build import open_session
from birdcage.station.events import PursuitChanged
from birdcage.station.known import CableTurn
from birdcage.station.pursuit_state import Phase
from birdcage_tui import run
from birdcage_tui.feeds.track_source import make_track
from birdcage_tui.main import parser

from tests.skymap.suns import around, simulated

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


def stage_of_the_pictures():
    """`scripts/stage.py`, which plays the real demo; `stage` is the tests' own."""
    if str(SCRIPTS) not in sys.path:
        sys.path.append(str(SCRIPTS))
    spec = importlib.util.spec_from_file_location("stage_of_the_pictures", SCRIPTS / "stage.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


async def until(on, wanted, seconds, step_s):
    """Let time pass until `wanted(pursuit)`; return how much did, and the phases met."""
    met, passed_s = [], 0.0
    while passed_s < seconds:
        on.app.session.step(step_s)
        passed_s += step_s
        for source in (on.app.sky.source, on.app.track.source):
            if source is not None:
                source.step()
        await on.pilot.pause()
        on.app._tick()
        pursuit = on.app.station.state.pursuit
        if pursuit is not None:
            if (pursuit.number, pursuit.phase) not in met:
                met.append((pursuit.number, pursuit.phase))
            if wanted(pursuit):
                return passed_s, met
    pytest.fail(f"not within {seconds} s: {met}")


def test_the_demo_follows_within_seconds_parks_and_waits_for_the_next_pass():
    scenery = stage_of_the_pictures()

    async def play():
        async with scenery.demo((80, 24), tour=True) as on:
            began_s, _ = await until(on, lambda one: one.phase is Phase.FOLLOWING and one.sample, 20.0, 0.5)
            assert on.app.station.state.pursuit.sample.error_deg < 1.0
            on.app.paint()
            await on.pilot.pause()
            row = on.text().splitlines()[0]
            met = []
            on.app.station.subscribe(
                lambda event: met.append(event.pursuit.phase) if isinstance(event, PursuitChanged) else None
            )
            await until(on, lambda one: one.phase is Phase.WAITING, 900.0, 15.0)
            position = on.app.station.state.position
            return began_s, row, list(dict.fromkeys(reversed(met)))[::-1], (position.az_deg, position.el_deg)

    began_s, row, phases, parked = asyncio.run(play())
    assert began_s <= 4.0
    assert "FOLLOW" in row
    assert Phase.COUNTDOWN in phases
    assert Phase.PARKING in phases[-3:]
    assert phases[-1] is Phase.WAITING
    assert parked == pytest.approx((180.0, 40.0), abs=0.5)


def test_the_desk_of_the_demo_has_its_passes_at_its_first_look_whoever_is_first(tmp_path):
    scenery = stage_of_the_pictures()
    clock, paths, told = VirtualClock(scenery.START), Paths.in_folder(tmp_path), []
    session = open_session(port="sim:g2", firmware="g2", baud=None, settings=scenery.HERE, paths=paths, clock=clock)
    source = make_track(session, scenery.HERE, lambda: scenery.HERE, paths, demo=True, threads=False)(told.append)
    source.start()
    source.desk.step()
    source.close()
    session.close()
    assert any(row.kept and row.name.startswith("DEMO") for row in told[0].schedule)


def test_the_demo_begins_with_a_cable_that_was_counted_earlier():
    scenery = stage_of_the_pictures()

    async def play(keys):
        async with scenery.demo((80, 24)) as on:
            await on.wait(2.0)
            await on.press(*keys)
            return on.app.station.state.turn, on.text()

    turn, dashboard = asyncio.run(play(()))
    assert turn is CableTurn.REMEMBERED
    assert "cable CCW 212°" in dashboard
    assert "cable, remembered CCW 212° left" in asyncio.run(play(("f2",)))[1]


def test_the_demo_of_a_person_begins_so_too(tmp_path):
    paths = Paths.in_folder(tmp_path)
    session, _settings, _services = run._build(parser().parse_args(["--demo"]), paths)
    session.close()
    assert [path.parent.parent.name for path in tmp_path.rglob("turn.json")] == ["dishes"]


def test_the_demo_keeps_what_its_maps_teach_but_not_in_a_file_of_yours(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("")
    sky_map = simulated(SimSettings, around(4.0, 4.0, 2.0))
    for asked, where in ((["--demo"], "birdcage.toml"), (["--demo", "--config", str(own)], "own.toml")):
        paths = Paths.in_folder(tmp_path).with_config(tmp_path / where)
        session, settings, _services = run._build(parser().parse_args(asked), paths)
        session.close()
        assert bool(settings.lessons.why_not_kept(sky_map)) == (where == "own.toml")
