"""One test on a running app: begun, gone to a page where that is asked for, and painted."""

import asyncio
from dataclasses import replace

import stand_in


def run(test, name="idle", size=(80, 24), *, key=None, state=None, **options):
    """Return what `test(app, pilot)` returns. `key` goes to a page first; `state` is what differs from the stand-in."""

    async def body():
        app = stand_in.app_in(name, **options)
        if state is not None:
            app.station.state = replace(app.station.state, **state)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            if key is not None:
                await pilot.press(key)
                await pilot.pause()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return await test(app, pilot)

    return asyncio.run(body())


def run_each(test, names=tuple(stand_in.STATES), size=(80, 24), **options):
    """Return what `test(app, pilot)` returns in each of these states, by name: one app that goes through them all."""

    async def through(app, pilot):
        found = {}
        for name in names:
            stand_in.change_to(app, name)
            app.paint()
            await pilot.pause()
            await pilot.pause()
            found[name] = await test(app, pilot)
        return found

    return run(through, names[0], size, **options)


async def read(app, _pilot):
    """Return all text that is seen."""
    return stand_in.text_of(app)
