"""Every sentence on the screen is plain and whole: pages, dialogs and lines, in every state, at two sizes and small."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from itertools import groupby

import calibrate_stand_in
import console_desk
import horizon_stand_in
import lessons_stand_in
import pytest
import setup_stand_in
import sky_stand_in
import stand_in
import track_stand_in
from birdcage.base.presets import Preset, add_preset
from birdcage.station.raw import CONSOLE
from places import PLACES, backups_in, doubt_sync, fill_system, open_map, press, recordings_in, settle
from said import Said

SMALL, LARGE = (80, 24), (160, 48)
SIZES = [SMALL, pytest.param(LARGE, marks=[pytest.mark.soak, pytest.mark.night])]
POCKET = (40, 12)
LONG = "Antenne auf dem Dach des Hauses 衛星通信局"
TYPED = ("", "231", "300 40", "+5 -2", "180 10", "180 999", "400 45", "E 40", "110W", "moon", "az=", "231,4,44", "<b>")
LINES = ("a 0 200", "nvse", "h 0", "q", "reboot", "nosuch", "a")


@pytest.fixture
def said(monkeypatch):
    return Said(monkeypatch)


def app_of(folder, place=None, state="idle"):
    presets = folder / "presets.toml"
    if not presets.exists():
        for name in ("Hot Bird", LONG):
            add_preset(presets, Preset(name, 164.2, 38.1, LONG))
    app = stand_in.app_in(
        state, setup=setup_stand_in.ENGINES[place.engine if place else "home"], presets_file=presets,
        history_file=folder / "history", sky=sky_stand_in.make(), horizon=horizon_stand_in.File(),
        keep_place=lambda *_place: None, calibrate=calibrate_stand_in.make(place.calibrate if place else "five"),
        recordings_file=recordings_in(folder), lessons=lessons_stand_in.Lessons(), backups_folder=backups_in(folder),
    )  # fmt: skip
    open_map(app, folder)
    app.track._make = track_stand_in.Source(
        track_stand_in.desk_in(place.track if place else "craft-idle", app.session.clock)
    )
    return app


def play(app, size, body):
    async def run():
        async with app.run_test(size=size) as pilot:
            await settle(app, pilot)
            await body(pilot)

    asyncio.run(run())


async def leave(app, pilot, *last):
    """Close every dialog and line, press these keys, and go to the first page."""
    while len(app.screen_stack) > 1:
        app.pop_screen()
        await pilot.pause()
    stand_in.change_to(app, "idle")  # while the dish moves, Esc stops it and closes nothing
    app.paint()
    await pilot.press("escape", "escape", *last, "f1")
    await settle(app, pilot)


def kind_of(place):
    return (place.engine, place.track, place.calibrate, place.size < (80, 24))


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_in_every_place(size, said, tmp_path):
    for kind, places in groupby(sorted(PLACES, key=kind_of), key=kind_of):
        places = list(places)
        app = app_of(tmp_path, places[0], "slewing")
        begun = app.station.state

        async def visit(pilot, app=app, places=places, begun=begun):
            for place in places:
                said.begin(place.name)
                app.station.state = replace(begun, **place.state)
                await settle(app, pilot)
                if place.keys[:1] == ("f4",):
                    fill_system(app)
                if place.asked_by == "SyncQuestion._confirm":
                    doubt_sync(app.station)
                await press(app, pilot, *place.keys)
                assert not place.dialog or type(app.screen).__name__ == place.dialog, place.name
                said.read(app)
                await leave(app, pilot, *{"f2": ["b"], "f4": ["h"]}.get(place.keys[0] if place.keys else "", []))

        play(app, POCKET if kind[-1] else size, visit)
    said.check()


@pytest.mark.parametrize("size", [*SIZES, POCKET], ids=str)
def test_in_every_state(size, said, tmp_path):
    app = app_of(tmp_path)

    async def visit(pilot):
        for page in ("f1", "f2", "f7", "f8") if size != POCKET else ("f1",):
            await press(app, pilot, page)
            for name in stand_in.STATES if page in ("f1", "f2") else ("idle", "not-homed", "travler", "opening"):
                said.begin(f"{page} {name}")
                stand_in.change_to(app, name)
                await settle(app, pilot)
                said.read(app)

    play(app, size, visit)
    said.check()


@pytest.mark.parametrize("size", [SMALL, LARGE], ids=str)
def test_in_every_scene_of_tracking(size, said):
    app = track_stand_in.app_in("craft-following")

    async def visit(pilot):
        for page in (("f1",), ("f2", "c")):
            await press(app, pilot, *page)
            for name in track_stand_in.SCENES:
                said.begin(f"{page} {name}")
                track_stand_in.change_to(app, name)
                await settle(app, pilot)
                said.read(app)

    play(app, size, visit)
    said.check()


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_while_one_types(size, said, tmp_path):
    app = app_of(tmp_path)

    async def visit(pilot):
        for state in ("idle", "held", "not-homed", "travler"):
            stand_in.change_to(app, state)
            for text in TYPED if state == "idle" else ("300 40",):
                said.begin(f"go to {text!r}, {state}")
                await pilot.press("g")
                app.focused.value = text
                await settle(app, pilot)
                said.read(app)
                await pilot.press("escape")

    play(app, size, visit)
    said.check()


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_on_the_console(size, said):
    async def visit(at):
        at.state(holder=CONSOLE, menu="mot")
        for line in LINES:
            said.begin(f"console {line}")
            await at.type(line)
            await at.look()
            said.read(at.app)
            await at.press("enter")
            await at.look()
            said.read(at.app)
            while len(at.app.screen_stack) > 1:
                at.app.pop_screen()
                await at.pilot.pause()
            at.line.value = ""

    console_desk.desk(visit, size=size)
    said.check()


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_with_nothing_to_show(size, said, tmp_path):
    app = stand_in.app_in(
        "idle", sky=sky_stand_in.make(up=(), rows=()), horizon=horizon_stand_in.File(), presets_file=tmp_path / "none"
    )
    app.track._make = track_stand_in.Source(track_stand_in.desk(None, found=(), schedule=()))

    async def visit(pilot):
        for keys in (("f1",), ("f2",), ("f2", "P"), ("f2", "c"), ("f7",), ("f8", "C"), ("f5",)):
            said.begin(f"empty {keys}")
            await press(app, pilot, *keys)
            said.read(app)
            await leave(app, pilot)

    play(app, size, visit)
    said.check()
