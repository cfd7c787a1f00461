"""A hostile name in everything that the app reads: no cell of any page orders the terminal about."""

import asyncio
import json
import unicodedata
from dataclasses import replace

import console_desk
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.station.build import open_session
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.feeds.track_source import make_track
from birdcage_tui.run import _app_settings
from birdcage_tui.shell.birdcage_app import BirdcageApp

EVIL = "EV\x1b]0;owned\x07\x1b[2J\x9b31mI\u202eL\u2066\u200f\x85X"
SEEN = "EV]0;own"


def orders(app):
    """What stands on the screen, and what of it is an order to a terminal."""
    text = stand_in.text_of(app)
    return text, {f"{ord(each):#x}" for each in text if unicodedata.category(each) in ("Cc", "Cf", "Cs")} - {"0xa"}


def hostile(folder, now):
    """A folder in which every name is hostile; the catalogue is one of before names were cleaned."""
    paths, quoted = Paths.in_folder(folder), json.dumps(EVIL)
    paths.config_file.write_text(
        f"[place]\nname = {quoted}\nlatitude_deg = 50\nlongitude_deg = 10\n[feed]\nactive = {quoted}\n[feed.{quoted}]\n"
        f"beam_deg = 4\n[motion]\nno_go_sectors = [[80, 100, 40, {quoted}]]\n[app]\n{quoted} = 1\n"
    )
    paths.presets_file.write_text(f"[[preset]]\nname = {quoted}\naz_deg = 180\nel_deg = 40\nnote = {quoted}\n")
    paths.history.parent.mkdir(parents=True, exist_ok=True)
    paths.history.write_text(f"{EVIL}\n", encoding="utf-8")
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.add([replace(each, name=f"{each.norad_id} {EVIL}") for each in demo_orbits(now, Observer(50, 10, 0))])
        for each in catalogue.entries():
            catalogue.set_favourite(each.key)
            catalogue.set_tags(each.key, [EVIL])
        catalogue._connection.execute("UPDATE satellite SET name = norad_id || ?", (f" {EVIL}",))
        catalogue._connection.execute("PRAGMA user_version = 1")
    return paths


def test_no_page_of_the_app_shows_an_order_to_the_terminal(tmp_path):
    async def play():
        clock = VirtualClock()
        paths = hostile(tmp_path, clock.utc())
        settings = load(paths.config_file, environ={})
        session = open_session(port="sim:g2", firmware="g2", baud=None, settings=settings, paths=paths, clock=clock)
        session.start = lambda: None  # stepped here instead of running on its thread
        app = BirdcageApp(
            session,
            replace(
                _app_settings(settings, paths, demo=False),
                sky=make_sky(settings, paths, clock, demo=False, threads=False),
                track=make_track(session, settings, lambda: settings, paths, demo=False, threads=False),
            ),
        )
        found = {}
        async with app.run_test(size=(160, 48)) as pilot:

            async def press(*keys):
                for key in keys:
                    await pilot.press(key)
                    await pilot.pause()
                for _ in range(2):
                    session.step(1.0)
                    for source in (app.sky.source, app.track.source):
                        if source is not None:
                            source.step()
                    await pilot.pause()
                app._tick()
                app.paint()
                await pilot.pause()
                return orders(app)

            for keys in (
                (),
                ("f2",),
                ("p",),
                ("f7",),
                ("f2", "c"),
                ("slash", *"owned"),
                ("enter",),
                ("escape", "f8"),
                ("f5",),
            ):
                found[keys] = await press(*keys)
        session.close()
        return found

    found = asyncio.run(play())
    assert {keys: bad for keys, (_text, bad) in found.items() if bad} == {}
    assert sum(SEEN in text for text, _bad in found.values()) >= 4, {
        keys: SEEN in text for keys, (text, _) in found.items()
    }


def test_the_console_shows_what_a_dish_sends_as_escapes():
    async def body(at):
        at.wire("<", EVIL.encode() + b"\r\n", EVIL.encode("latin-1", "replace") + b"\n")
        at.wire("#", EVIL.encode())
        await at.look()
        return orders(at.app)

    text, bad = console_desk.desk(body, size=(160, 48))
    assert bad == set()
    assert r"EV\x1b]0;owned\x07\x1b[2J" in text
