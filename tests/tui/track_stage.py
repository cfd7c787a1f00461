"""Runs a test on the Craft tab, in a scene of `track_stand_in`."""

from __future__ import annotations

import asyncio

import stand_in
import track_stand_in

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


def run(test, name="craft-following", size=(80, 24), keys=("f2", "c"), **options):
    """Return what `test(app, pilot, desk)` returns, on the Craft tab in a scene."""

    async def body():
        app = track_stand_in.app_in(name, **options)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            for key in keys:
                await pilot.press(key)
                await pilot.pause()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return await test(app, pilot, app.track.source)

    return asyncio.run(body())


def run_each(test, size):
    """Return what `test(app, pilot, desk)` returns in each scene, by name: one app that goes through them all."""

    async def through(app, pilot, desk):
        found = {}
        for name in track_stand_in.SCENES:
            track_stand_in.change_to(app, name)
            await pilot.pause()
            app.paint()
            await pilot.pause()
            await pilot.pause()
            found[name] = await test(app, pilot, desk)
        return found

    return run(through, next(iter(track_stand_in.SCENES)), size)


async def read(app, _pilot, _desk):
    return stand_in.text_of(app)
