"""The Calibrate tab of F8 over a stand-in guide, opened for a test."""

from __future__ import annotations

import asyncio

import calibrate_stand_in
import stand_in
from setup_stage import press, settle

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


def run(test, scene="five", size=(80, 24), state="idle", **options):
    async def body():
        app = stand_in.app_in(state, calibrate=calibrate_stand_in.make(scene), **options)
        async with app.run_test(size=size) as pilot:
            await settle(app, pilot)
            await press(app, pilot, "f8")
            await press(app, pilot, "C")
            await settle(app, pilot)
            return await test(app, pilot, app.calibrate.source)

    return asyncio.run(body())


async def read(app, _pilot, _source):
    return stand_in.text_of(app)


def flat(text):
    """The words as one reads them, whatever frames are between them."""
    return " ".join(text.replace("│", " ").split())


def pane_text(pane):
    """The words of one pane, in one line."""
    return " ".join(" ".join("".join(row) for row in pane._cells._chars).split())
