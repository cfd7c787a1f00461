"""The app at F8 over the stand-in engine, and how to wait for it."""

import asyncio

import setup_stand_in
import stand_in


def run(test, engine="home", state="idle", size=(80, 24), **options):
    async def body():
        made = setup_stand_in.ENGINES[engine]()
        app = stand_in.app_in(state, setup=lambda: made, first_page="setup", **options)
        async with app.run_test(size=size) as pilot:
            await settle(app, pilot)
            await settle(app, pilot)
            return await test(app, pilot, made)

    return asyncio.run(body())


async def settle(app, pilot):
    """Draw one frame, and wait until the layout has followed it."""
    app.paint()
    for _ in range(3):
        await pilot.pause()


async def press(app, pilot, *keys):
    await pilot.press(*keys)
    await settle(app, pilot)


async def read(app, pilot, engine):
    return stand_in.text_of(app)
