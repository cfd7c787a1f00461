"""What each picture of the README shows: a page, and the keys that lead there."""

from __future__ import annotations

import math
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from datetime import timedelta

from birdcage.base.journal import Journal
from birdcage.base.journal_rows import DishIncident, IncidentKind, JournalEntry, ReplyCount
from birdcage.base.wear import Wear, WearBook
from network_clients import Gpredict, programs
from stage import Stage

SIZE = (120, 36)


@dataclass(frozen=True)
class Scene:
    """One picture: its name, what is done for it, and what must then be readable."""

    name: str
    play: Callable[[Stage], Awaitable[None]]
    seen: tuple[str, ...]
    size: tuple[int, int] = SIZE
    theme: str = "dusk"
    tour: bool = False


@dataclass(frozen=True)
class MovingScene:
    """A picture that moves: how it begins, then so many frames of the app, `every_s` of the dish's time apart.

    Each is shown for `shown_s`: what is seen runs `every_s / shown_s` times as fast as the dish.
    """

    name: str
    begin: Callable[[Stage], Awaitable[None]]
    seen: tuple[str, ...]
    """What must be readable in each frame."""
    frames: int
    every_s: float
    shown_s: float
    size: tuple[int, int]
    theme: str = "dusk"


async def dashboard(on: Stage) -> None:
    """The demo, a minute after its start: in mid-pass."""
    await on.wait(62.3)


async def in_pass(on: Stage) -> None:
    """The demo, as its dish begins to follow."""
    await on.wait(15.3)


async def control(on: Stage) -> None:
    """On its way by hand: a go-to, and a step more."""
    await on.wait(9)
    await on.press("f2", "g")
    await on.type("205 38")
    await on.press("enter")
    await on.wait(4)
    await on.press("g")
    await on.type("148 44")
    await on.press("enter")
    await on.wait(0.4)


async def craft(on: Stage) -> None:
    """Following the Moon, two minutes after it was chosen: what an earlier app's picture of this page shows."""
    await on.wait(9)
    await on.press("f2", "c", "slash")
    await on.type("moon")
    await on.wait(0.4)
    await on.press("enter")
    await on.wait(2)
    await on.press("f", "enter")
    await on.wait(120)


async def signal(on: Stage) -> None:
    """Peaking by hand on 119° W: once around it in steps of 2°, so that its middle is known, and halfway there."""
    await on.wait(9)
    await on.press("f3", "g")
    await on.type("119W")
    await on.press("enter")
    await on.wait(8)
    await on.press("x", "plus")
    for key in ("right", "up", "up", "left", "left", "left", "down", "down", "down", "down", "right", "right", "up"):
        await on.press(key)
        await on.wait(3)


async def sky_map(on: Stage) -> None:
    """A whole map of the arc, heard by the dish's own tuner."""
    await on.wait(9)
    await on.press("f3", "m")
    await on.wait(1)
    await on.press("enter")
    await on.wait(380)


async def console(on: Stage) -> None:
    """Talking to the firmware over the dashboard; the last line is not sent yet, and warned of."""
    await on.wait(12)
    await on.press("f5")
    await on.press("i")
    for line in ("q", "dvb", "rssi 5", "q", "mot", "elminmaxhome", "a"):
        await on.type(line)
        await on.press("enter")
        await on.wait(0.4)
    await on.type("a 0 9999")
    await on.wait(0.2)


async def setup(on: Stage) -> None:
    """The eleven steps, as far as the simulated dish is known."""
    await on.wait(9)
    await on.press("f8")
    await on.wait(1)


async def pocket(on: Stage) -> None:
    """On a phone, at the dish."""
    await on.wait(9)
    await on.press("g")
    await on.type("205 38")
    await on.press("enter")
    await on.wait(0.5)


async def passes(on: Stage) -> None:
    """What comes next, and a pass that the cable interrupts for some seconds."""
    await on.wait(9)
    await on.press("f7", "down", "down", "down", "down", "down")


async def world(on: Stage) -> None:
    """The world under the same pass, at the moment at which it comes into reach."""
    await passes(on)
    await on.press("w", "e", "e")
    await on.wait(1)


async def network(on: Stage) -> None:
    """Gpredict's satellite is recognised; SatDump would have the dish too, SatNOGS watches."""
    await on.wait(9)
    await on.press("f2", "N")
    with programs(on, 45806, 45812, 45820) as (first, satdump, satnogs):
        satnogs.ask("\\dump_state")
        gpredict = Gpredict(first)
        gpredict.read()
        for second in range(60):
            gpredict.wish(on.app.session.clock.utc().timestamp())
            await on.wait(0.1)
            gpredict.read()
            await on.wait(0.4)
            satdump.ask("p")
            satdump.ask(f"P {172.0 + 0.3 * second:.2f} {38.6 + 0.2 * second:.2f}")
            if second % 3 == 0:
                satnogs.ask("p")
            await on.wait(0.5)


def remember_month(on: Stage) -> None:
    """Keep a made-up month of the demo's dish: steady use, two stalls of the elevation, one restart."""
    dish, now = "Carryout G2 (demo)", on.app.session.clock.utc()
    journal, book = Journal(on.paths.journal), WearBook(on.paths.journal)
    for days_ago, el_deg in ((3, 62.0), (1, 65.0)):
        utc = now - timedelta(days=days_ago, hours=4)
        journal.append(JournalEntry(utc, "dish", "stall", "DEMO: EL stalled.", dish, "elevation", False, 190.0, el_deg))
    journal.append(DishIncident(now - timedelta(days=6), dish, IncidentKind.RESTART, False, "demo", ""))
    for days_ago in range(45):
        day = (now - timedelta(days=days_ago)).date()
        journal.append(ReplyCount(dish, "demo", day, 1374, int(days_ago % 15 == 4), 0, 0))
        busy = 0.4 + 0.6 * abs(math.sin(days_ago * 1.7))
        for motor, degrees in ((0, 9600.0), (1, 2500.0)):
            book.add(dish, Wear(motor, 40, degrees * busy, 38), day)
    for writer in (journal, book):
        writer.flush()
        writer.close()


async def health(on: Stage) -> None:
    """A dish whose elevation has stalled twice."""
    remember_month(on)
    await on.wait(12)
    await on.press("f4")
    await on.wait(6)


async def system(on: Stage) -> None:
    """What the dish tells of its hardware, a few seconds after the page was opened."""
    await on.wait(12)
    await on.press("f4", "b", *["down"] * 14)
    await on.wait(4)


async def nvs(on: Stage) -> None:
    """An edit that is not written yet, with what a source tells of the row."""
    await on.wait(12)
    await on.press("f4", "n")
    await on.wait(3)
    await on.press(*["down"] * 22, "e")
    await on.type("600")
    await on.press("enter")
    await on.wait(1)


SCENES = (
    Scene("tui-dashboard", dashboard, ("FOLLOWING LEO 1", "error 0.", "LOS", "Health"), (160, 48), tour=True),
    Scene("tui-control", control, ("SLEWING", "Cable")),
    Scene("tui-network", network, ("Gpredict follows LEO 1", "SatDump", "ignored 59", "watches", "RPRT 0")),
    Scene("tui-craft-tracking", craft, ("FOLLOWING Moon", "of the beam", "Azimuth, elevation, error"), (160, 48)),
    Scene("tui-signal", signal, ("% of the peak", "Fit of", "readings a second", "lock")),
    Scene("tui-sky-map", sky_map, ("The map is complete", "101W", "119W", "counts", "loudest")),
    Scene("tui-system", system, ("Identity", "12-IN G2", "Drivers", "A3981> diag", "OK")),
    Scene("tui-health", health, ("stalled", "What to do", "Link and power"), (160, 48)),
    Scene("tui-nvs", nvs, ("Sleep Mode Timer Secs", "420", "not written yet", "1 to write")),
    Scene("tui-console", console, ("Min: 18.00", "beyond the limit")),
    Scene("tui-setup", setup, ("TV search", "North")),
    Scene("tui-craft-search", passes, ("Timeline of favourites", "in reach", "Doppler"), (160, 48)),
    Scene("tui-world", world, ("Sun overhead", "in view here")),
    Scene("tui-pocket", pocket, ("S T O P",), (40, 12), "daylight"),
)
MOVING = MovingScene(
    "tui-demo",
    in_pass,
    ("FOLLOWING LEO 1", "STOP", "What next"),
    frames=24,
    every_s=3.0,
    shown_s=0.3,
    size=(100, 30),
)
"""The one at the head of the README: the dish follows a satellite, ten times as fast as it does."""
NOT_BUILT = ("tui-camera",)
"""Pictures of an earlier app whose pages this version does not have."""
COLLAGE = ("tui-dashboard", "tui-control", "tui-signal", "tui-system", "tui-console", "tui-craft-search")
