"""The console with two dishes in one app: it closes when the other is shown, and each dish has a log of its own."""

from __future__ import annotations

import stand_in
from birdcage.station.raw import TranscriptEntry
from test_two_dishes import other, run


def test_the_console_of_one_dish_is_closed_when_the_other_is_shown():
    async def console(app, pilot):
        await pilot.press("5")
        await pilot.pause()
        assert app.stage.open_sheet is not None
        await other(pilot)
        assert app.stage.open_sheet is None
        await pilot.press("5")
        await pilot.pause()
        assert app.stage.open_sheet._tap is app.dishes.all[1].tap

    run(console, "idle", "idle")


def test_each_dish_keeps_the_log_of_its_console_while_the_other_is_shown():
    def passes(app, number, words):
        app.dishes.all[number].tap.take_in(TranscriptEntry(app.session.clock.utc(), "<", f"{words}\r\n".encode()))

    async def seen(app, pilot):
        await pilot.press("5")
        await pilot.pause()
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return [words for words in ("one", "two", "three", "other") if f"it was {words}" in stand_in.text_of(app)]

    async def log(app, pilot):
        passes(app, 0, "it was one")
        passes(app, 1, "it was other")
        looks = [await seen(app, pilot)]
        passes(app, 0, "it was two")
        await other(pilot)
        looks.append(await seen(app, pilot))
        passes(app, 0, "it was three")
        await other(pilot)
        return [*looks, await seen(app, pilot)]

    assert run(log, "idle", "idle", size=(120, 36)) == [["one"], ["other"], ["one", "two", "three"]]
