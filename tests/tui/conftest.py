"""Runs the app in a loop that never waits. The stand-in lies beside the tests: importlib mode adds no folder."""

import asyncio
import sys
import weakref
from pathlib import Path

import pytest
import textual.app
import textual.pilot
from birdcage.base.presets import Preset, add_preset
from textual._compositor import Compositor
from textual._styles_cache import StylesCache
from textual.css.stylesheet import Stylesheet

sys.path.insert(0, str(Path(__file__).parent))

import jumping_loop

BY_NIGHT = {(200, 60), (240, 70)}
"""Sizes greater than the three that every widget is held to: what they show is looked at in a night (`-m soak`)."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    for item in items:
        if getattr(item, "callspec", None) and item.callspec.params.get("size") in BY_NIGHT:
            item.add_marker(pytest.mark.soak)
            item.add_marker(pytest.mark.night)


@pytest.fixture
def kept(tmp_path):
    """The path of a presets file with twelve directions in it."""
    path = tmp_path / "presets.toml"
    for index in range(12):
        add_preset(path, Preset(f"Direction {index}", 30.0 * index, 20.0 + index, "a note" if index % 2 else ""))
    return path


@pytest.fixture(autouse=True)
def _forget_the_drawn():
    """Let go of what Textual remembers of the last thousand widgets, all that they drew included."""
    yield
    StylesCache.get_inner_outer.cache_clear()


_render_update = Compositor.render_update
ONE_IN = 10
"""Of so many frames one is drawn."""


@pytest.fixture(autouse=True)
def _never_wait(monkeypatch):
    """Let time jump where the app only waits for it."""
    before = asyncio.get_event_loop_policy()
    jumping_loop.let_time_jump(monkeypatch.setattr)
    undrawn, passed = {}, weakref.WeakKeyDictionary()

    async def settle(*_):
        await jumping_loop.settle()
        while undrawn:
            compositor, stack = undrawn.popitem()
            if compositor.root is not None and compositor.root.is_current:
                passed[compositor] = passed.get(compositor, 0) + 1
                if passed[compositor] % ONE_IN == 1:
                    _render_update(compositor, screen_stack=stack)

    def render_later(compositor, full=False, screen_stack=None, simplify=False):
        if full:  # a picture
            return _render_update(compositor, full, screen_stack, simplify)
        # No terminal sees a frame of these apps, and `text_of` draws its own: of those of a settled app it is enough to
        # draw the first of each screen, and one now and then.
        undrawn[compositor] = screen_stack
        return None

    monkeypatch.setattr(Compositor, "render_update", render_later)
    monkeypatch.setattr(textual.app, "wait_for_idle", settle)
    monkeypatch.setattr(textual.pilot, "wait_for_idle", settle)
    yield
    asyncio.set_event_loop_policy(before)


_parse_rules = Stylesheet._parse_rules
_parsed = {}


def _parse_rules_once(sheet, *source, **more):
    key = (frozenset(sheet._variables.items()), source, tuple(more.items()))
    if key not in _parsed:
        _parsed[key] = _parse_rules(sheet, *source, **more)
    return _parsed[key]


@pytest.fixture(autouse=True)
def _parse_styles_once(monkeypatch):
    """Share among all apps what their style sheets say, which nothing changes after it was parsed."""
    monkeypatch.setattr(Stylesheet, "_parse_rules", _parse_rules_once)
