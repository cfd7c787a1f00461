"""A map from the dialog to its end, in the demo: begun, paused, gone on with, whole; every direction once."""

from __future__ import annotations

import asyncio

from birdcage.skymap.map_file import list_maps, read_map
from birdcage_tui.signal.map_pane import MapPane
from test_demo import stage_of_the_pictures
from textual.widgets import Input

REGION = ("200:212", "36:42", "2")


def test_a_map_is_made_paused_and_gone_on_with():
    async def body():
        async with stage_of_the_pictures().demo((120, 36)) as on:
            on.app.maps.beside = lambda work: work()
            await on.wait(8)
            await on.press("f3", "m")
            for field, value in zip(on.app.screen.query(Input), REGION, strict=False):
                field.value = value
            await on.press("enter")
            await on.wait(6)
            running = on.text()
            await on.press("e")
            await on.wait(2)
            paused, done = on.text(), on.app.maps.book.shown.heard
            await on.press("u")
            asked = on.text()
            await on.wait(2)
            await on.press("y")
            await on.wait(20)
            path = on.app.settings.recordings_file
            heads = list_maps(path)
            sky = read_map(path, heads[0].number)
            shown, pane = on.app.maps.book.shown, on.app.query_one(MapPane)
            return running, paused, done, asked, on.text(), heads, sky, shown, pane.region.area

    running, paused, done, asked, over, heads, sky, shown, area = asyncio.run(body())
    assert "running, " in running
    assert " of 28, " in running
    assert 0 < done < 28
    assert f"paused at {done} of 28" in paused
    assert "u resumes it" in paused
    assert f"{28 - done} directions, about" in " ".join(asked.split())
    assert "finished" in over
    assert "all 28 heard" in over
    assert len(heads) == 1, "it is the same map that went on"
    assert sorted(each.cell for each in sky.samples) == list(range(28))
    assert [shown.value(each.cell) for each in sky.samples] == [each.value for each in sky.samples]
    assert area > 0
