"""No single letter starts a motion longer than one jog step: on every page, with all that one press does there."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import pytest
from birdcage.base.geometry import separation
from birdcage.sim.port import open_device
from birdcage.station import requests as ask
from birdcage.station.requests import Home
from birdcage_tui.commands import for_key, in_force
from birdcage_tui.commands.jog import STEPS_DEG
from birdcage_tui.shown.allowed import RESUME_KEY as RESUME
from burst import settle
from key_storm import stage_of_the_pictures
from textual.widgets import Input

ASKED_FIRST = frozenset({"enter", "space", "escape", "ctrl+q", "ctrl+c", "ctrl+p", "ctrl+o"})
"""What is no plain key, or does what was shown before. `U` takes up what STOP has interrupted, and row 2 says so."""
STEPS = (ask.Jog, ask.TurnSkew)
MOTIONS = (ask.Goto, ask.Follow, ask.Pursue, ask.Home, ask.Stow, *STEPS)
PLACES = {
    "dashboard": (),
    "pocket": (),
    "pocket, passes": ("f",),
    "control": ("f2",),
    "digits": ("f2", "n"),
    "presets": ("f2", "p"),
    "craft": ("f2", "c", "slash", "m", "o", "o", "n", "enter"),
    "craft, offered": ("f2", "c", "slash", "m", "o", "o", "n", "enter", "f"),
    "network": ("f2", "N"),
    "console": ("f5",),
    "passes": ("f7",),
    "world": ("f7", "w"),
    "setup, home": ("f8",),
    "calibrate": ("f8", "C"),
    "calibrate, objects": ("f8", "C", "o"),
    "calibrate, peaks": ("f8", "C", "p"),
}

NAMED = {
    "pocket": {"f", "j"}, "pocket, passes": {"j", "l", "h"},
    "dashboard": {"H", "f", "left", "K"}, "control": {"W", "E", "j"}, "digits": {"k", "l"}, "presets": {"d"},
    "craft": {"f", "a", "A"}, "craft, offered": {"f", "a", "A"}, "network": {"b"}, "console": {"i"},
    "passes": {"f"}, "world": {"f"}, "setup, home": {"h"}, "calibrate": {"n", "m"},
    "calibrate, objects": {"n", "m"}, "calibrate, peaks": {"n", "d"},
}  # fmt: skip
"""Some of the keys that are tried there."""


def plain_keys(app):
    """Return the keys of one press that do something here; on the setup page the letters of the answers, too.

    Those that hold everywhere are tried on the dashboard.
    """
    scopes = [scope.scope for scope in app.stage.scopes()]
    keys = [key for command in in_force(scopes) for key in command.keys
            if for_key(key, scopes) is command and (command.where or "dashboard" in scopes)]  # fmt: skip
    if app.page.scope == "setup":
        keys += [choice.key for choice in app.page.answers()]
    return [key for key in dict.fromkeys(keys) if key not in {*ASKED_FIRST, RESUME} and not key.startswith("f1")
            and not (key[0] == "f" and key[1:].isdigit()) and not key.isdigit()]  # fmt: skip


class Watched:
    """The demo without its tour, at rest and homed; it notes what motions are asked for."""

    def __init__(self, on):
        self.on, self.app = on, on.app
        self.dish = open_device(self.app.station.state.port.removeprefix("sim:"), clock=self.app.session.clock)
        self.asked = []
        submit = self.app.station.submit

        def submitting(request):
            self.asked += [request] if isinstance(request, MOTIONS) else []
            return submit(request)

        self.app.station.submit = submitting

    async def press(self, *keys):
        for key in keys:
            await self.on.pilot.press(key)
            await settle(self.app)
            await self.step(0.3)

    async def step(self, seconds):
        app = self.app
        app.session.step(seconds)
        for source in (app.sky.source, app.track.source, app.calibrate.source):
            if source is not None:
                source.step()
        app._tick()
        await settle(app)

    async def go(self, place):
        """Go there from a bare page."""
        app, keys = self.app, PLACES[place]
        for _ in range(4):
            if len(app.screen_stack) == 1 and not isinstance(app.focused, Input):
                break
            await self.press("escape")
        await self.press("f1", *keys)
        if place.startswith("setup"):
            app.page.engine.clear()
            app.page.engine.go(place.removeprefix("setup, "))
            app.page.follow()
            await self.step(0.3)
        assert app.station.state.held is None

    @property
    def there(self):
        """What has to be the same for the next key to be pressed in the same place."""
        app = self.app
        return [scope.scope for scope in app.stage.scopes()], len(app.screen_stack), type(app.focused)


@pytest.mark.parametrize("place", PLACES)
def test_no_plain_key_moves_the_dish_farther_than_a_jog_step(place):
    async def body():
        wrong = []
        async with stage_of_the_pictures().demo((40, 12) if "pocket" in place else (80, 24)) as on:
            watched = Watched(on)
            await watched.step(6.0)
            app = on.app
            app.settings = replace(app.settings, presets_file=None)
            app.station.submit(Home("you"))
            await watched.step(60.0)
            assert app.station.state.homed
            await watched.go(place)
            every, there = plain_keys(app), watched.there
            assert NAMED[place] <= {*every}
            for key in every:
                if watched.there != there:
                    await watched.go(place)
                watched.asked.clear()
                before = watched.dish.truth()
                await watched.press(key)
                await watched.step(1.0)
                after = watched.dish.truth()
                turned = max(
                    separation(before.az_deg, before.el_deg, after.az_deg, after.el_deg),
                    abs((after.az_deg - before.az_deg + 180.0) % 360.0 - 180.0), abs(after.el_deg - before.el_deg),
                )  # fmt: skip
                far = [each for each in watched.asked if not isinstance(each, STEPS)]
                if far or turned > STEPS_DEG[-1] + 0.5:
                    wrong.append(f"{key} turned it by {turned:.1f}°: {far}")
                    watched.app.station.stop("you")
                    await watched.step(5.0)
                    app.station.submit(ask.Release("you"))
                    await watched.step(1.0)
        return wrong

    assert asyncio.run(body()) == []
