"""A storm of keys, in one thread on a virtual clock: what no key may do, wherever and however fast it is pressed."""

from __future__ import annotations

import importlib.util
import random
import sys
from collections import Counter
from pathlib import Path
from string import ascii_letters, digits

from birdcage.sim.port import open_device
from birdcage.station import requests as ask
from birdcage.station.state import Activity
from birdcage_tui.commands import KEYS
from birdcage_tui.shell.birdcage_app import BirdcageApp
from burst import settle, write
from textual.events import Key
from textual.widgets import Input, TextArea

BURSTS = (1, 2, 3, 5, 8, 12, 20)
EVERY = [*(key for key in KEYS if key != "ctrl+q"), *ascii_letters, *digits]
OFTEN = ["enter", "escape", "y", "tab", "left", "up", "f5", "question_mark", "colon", "semicolon"]
OTHERS = ["space", "ctrl+c", "shift+tab", "backspace", "home", "end", "pageup", "pagedown", "delete", "comma",
          "full_stop", "ctrl+r", "ctrl+u", "ctrl+w", "ctrl+k", "ctrl+a", "f11", "shift+left", "ctrl+end"]  # fmt: skip
WAYS = tuple(
    tuple(way.split())
    for way in (
        "f1", "f2", "f2 p", "f2 n", "f2 c", "f2 c v", "f2 c slash", "f2 N", "f2 D", "f2 t", "f2 Z", "f2 a", "f2 slash",
        "f2 v", "f2 R", "f2 E", "f3", "f4", "f5", "f5 i", "f5 i a enter", "f5 slash", "f5 i ctrl+r", "f6", "f7", "f7 t",
        "f7 w", "f7 slash", "f8", "f8 w", "f8 C", "f8 C X", "f8 C a", "f9", "f10", "g", "H", "question_mark", "colon",
        "semicolon",
    )
)  # fmt: skip
"""To every page, and to what lies over it."""
MOVES = {
    ask.Jog: {"left", "right", "up", "down", *"hjkl", "enter"},
    ask.TurnSkew: {"enter", "less_than_sign", "greater_than_sign"},
    ask.Goto: {"enter", "up", "down", *"jk"},
    ask.Home: {"y"},
    ask.Stow: {"y"},
    ask.Engage: {"y"},
    ask.ReleaseMotors: {"y"},
    ask.SetSearch: {"y"},
    ask.AcceptLimits: {"y"},
    ask.Raw: {"enter", "y"},
}
"""What may move the dish, and the keys of which one must have been pressed for it."""
TURNING = ("a ", "h ", "g ", "home", "stow")
"""How the lines begin that turn a motor of a G2."""
REST_S, QUIET_S = 4.0, 20.0


class Storm:
    """One app, its dish, what is pressed, and what was wrong about what came of it."""

    def __init__(self, seed: int, app: BirdcageApp) -> None:
        self.rng, self.app, self.seed = random.Random(seed), app, seed
        self.dish = open_device(app.station.state.port.removeprefix("sim:"), clock=app.session.clock)
        # Ctrl+Q is not pressed, but the palette finds `Quit` by two letters: the storm goes on.
        app.ending.leave = lambda *_by: None
        self.pressed, self.wrong, self.met = 0, [], Counter()
        self.last: list[str] = []
        self._before: list[str] = []
        self._since: list[str] = []
        """What was pressed since the page lay bare, and before that: a line for the dish may wait for control."""
        self._stops = self._out = 0
        self._fates: dict[int, str] = {}
        station, keys = self.app.station, self.app.keys
        submit, stop, deal, means_stop = station.submit, station.stop, keys._deal, keys._means_stop
        self.requests: list[object] = []

        def submitting(request):
            self.requests.append(request)
            self._judge(request)
            return submit(request)

        def stopping(by, **more):
            self._stops += 1
            return stop(by, **more)

        async def dealing(typed):
            if isinstance(typed, Key) and typed.key == "space":
                self._typed(typed)
            else:
                self._fates[id(typed)] = "dealt"
            await deal(typed)

        def meaning_stop(key):
            stops = means_stop(key)
            if stops:
                self._fates[id(key)] = "stop"
            return stops

        station.submit, station.stop = submitting, stopping
        keys._deal, keys._means_stop = dealing, meaning_stop
        self.app.session.on_wire(self._heard)

    def _heard(self, entry) -> None:
        self._out += entry.direction == ">"

    def note(self, words: str) -> None:
        self.wrong.append(f"seed {self.seed}, after {self.pressed} keys: {words}; last {self.last[-4:]}")

    def _judge(self, request) -> None:
        """A motion is asked for by a key that may do so, unless the letters of a jump lie over the page."""
        by = MOVES.get(type(request))
        if by is None or (isinstance(request, ask.Raw) and not request.line):
            return
        typed = {*self._before, *self._since}
        if not (by | {"semicolon", "ctrl+o"}) & typed:
            self.note(f"{request} was asked for by {sorted(typed)}")

    def _typed(self, key) -> None:
        """Space is a letter only in a text field that a person sees."""
        field = self.app.focused
        if not isinstance(field, Input | TextArea) or not field.region.area or not field.is_on_screen:
            self.note(f"Space went to {field}")
        self._fates[id(key)] = "letter"

    # Keys.

    async def press(self, *names: str) -> None:
        """Write the keys at once, and let the app deal with them."""
        app = self.app
        self.pressed += len(names)
        top = type(app.screen).__name__
        self.last.append(f"{top}: {' '.join(names)}")
        self.met[top] += 1
        self._since += names
        self._fates.clear()
        stops = self._stops
        keys = write(app, *names)
        await settle(app)
        if app._exception is not None or not app.is_running:
            raise AssertionError(f"the app has ended: {self.last[-5:]}") from app._exception
        if app.calibrate.source is not None:
            app.calibrate.source.step()
        self.met[type(app.screen).__name__] += 1
        self.met[app.page.id if not app.stage.folded else "pocket"] += 1
        if self._stops - stops < sum(name == "ctrl+c" for name in names):
            self.note("a Ctrl+C was no STOP")
        spent = [self._fates.get(id(key), "") for key in keys]
        for index, key in enumerate(keys):
            if key.key == "space" and not spent[index] and "stop" not in spent[index + 1 :]:
                # What waited behind a STOP goes with it; once anything after it was dealt with, no Space may.
                since = "".join(fate or "-" for fate in spent[:index]).rpartition("stop")
                if not since[1] or since[2].strip("-"):
                    self.note("a Space was lost")

    def step(self, seconds: float) -> None:
        """Let so much time of the dish pass."""
        app = self.app
        app.session.step(seconds)
        for source in (app.sky.source, app.track.source, app.calibrate.source):
            if source is not None:
                source.step()
        app._tick()

    def _turned(self, since: float) -> list[str]:
        shell = self.dish.shell
        return [line for at, line in shell.received if at > since and line.startswith(TURNING)]

    async def gust(self, way: tuple[str, ...]) -> None:
        """Go somewhere, one key at a time or all at once; then keys at random."""
        rng = self.rng
        for keys in (way,) if rng.random() < 0.6 else [(key,) for key in way]:
            await self.press(*keys)
        for _ in range(rng.randrange(1, 3)):
            await self.press(*(self._key() for _ in range(rng.choice(BURSTS))))
            if rng.random() < 0.3:
                self.step(rng.choice((0.05, 0.3, 1.0)))

    def _key(self) -> str:
        kind = self.rng.random()
        return self.rng.choice(OFTEN if kind < 0.35 else OTHERS if kind < 0.5 else EVERY)

    async def stop(self) -> None:
        """STOP from wherever the storm has led: on the wire in the same call, and nothing moves until it is let go."""
        app, state = self.app, self.app.station.state
        motion = state.motion
        driven = motion is not None and state.held is None and motion.eta > app.session.clock.monotonic() + 0.5
        stops, out = self._stops, self._out
        key = "ctrl+c" if isinstance(app.focused, Input) or self.rng.random() < 0.5 else "space"
        write(app, key)
        if self._stops != stops + 1:
            self.note(f"{key} is no STOP here: {app.screen}, {app.focused}")
        silent = driven and self._out == out
        await settle(app)
        self.pressed += 1
        self.last.append(f"STOP by {key}")
        homing = app.station.state.activity is Activity.HOMING
        self.step(40.0 if homing else REST_S)
        if app.station.state.held is None:
            self.note("STOP does not hold")
        if silent:
            self.note(f"STOP has sent nothing while the dish moves: {motion}, {app.station.state.last_stop}")
        if self.dish.truth().moving:
            self.note(f"it moves after STOP: {app.station.state.activity}")
        since = app.session.clock.monotonic()
        self.step(QUIET_S)
        if self._turned(since):
            self.note(f"it was turned while held: {self._turned(since)}")

    async def home(self) -> None:
        """Esc until the page lies bare; then F1, and Enter lets go."""
        app = self.app
        self._before, self._since = self._since, []
        for _ in range(4):
            await self.press("escape", "escape", "escape", "f1")
            if len(app.screen_stack) == 1 and not isinstance(app.focused, Input):
                break
            self.step(
                20.0 if app.station.state.activity is Activity.HOMING else REST_S
            )  # Esc has stopped what may move
        if len(app.screen_stack) != 1 or isinstance(app.focused, Input):
            self.note(f"Esc does not lead back: {app.screen}, {app.focused}, {app.station.state.activity}")
        for _ in range(3):
            if app.station.state.held is not None or app.station.state.fault is not None:
                await self.press("enter")
                self.step(0.5)
        if app.station.state.held is not None:
            self.note("Enter does not let go")


def stage_of_the_pictures():
    """`scripts/stage.py`, which plays the real demo; `stage` is the tests' own."""
    scripts = Path(__file__).resolve().parents[2] / "scripts"
    if str(scripts) not in sys.path:
        sys.path.append(str(scripts))
    spec = importlib.util.spec_from_file_location("stage_of_the_pictures", scripts / "stage.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


async def blow(seed: int, keys: int, size=(80, 24)) -> Storm:
    """Storm over the demo until so many keys were pressed; return what was met, and what was wrong."""
    async with stage_of_the_pictures().demo(size) as on:
        storm = Storm(seed, on.app)
        storm.step(3.0)
        await settle(on.app)
        ways: list[tuple[str, ...]] = []
        while storm.pressed < keys:
            for _ in range(storm.rng.randrange(3, 6)):
                ways = ways or storm.rng.sample(WAYS, len(WAYS))
                await storm.gust(ways.pop())
                await storm.home()
            await storm.gust(storm.rng.choice(WAYS))
            await storm.stop()
            await storm.home()
        return storm
