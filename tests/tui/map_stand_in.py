"""A sky as a small dish hears it, maps of it in a file, and the app around one that is under way."""

import asyncio
import math
import random
from dataclasses import replace

import stand_in
from birdcage.base.geometry import separation
from birdcage.signal.slots_heard import seen_from
from birdcage.sky.observer import Observer
from birdcage.skymap.map_file import MapWriter, NewMap
from birdcage.skymap.plan import MapPlan
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage_tui.shown.map_book import MapRead

from tests.skymap.made import made_map

OBSERVER = Observer(stand_in.PLACE.latitude_deg, stand_in.PLACE.longitude_deg)
WIDTH_DEG = 2.6
PLAN = MapPlan(130.0, 250.0, 18.0, 50.0, 1.0)
KEY = "a-map"


def tree_deg(az_deg):
    """How high trees stand."""
    return 21.0 + 4.0 * math.sin(az_deg / 9.0) + 5.0 * math.exp(-(((az_deg - 236.0) / 7.0) ** 2))


def level(az_deg, el_deg):
    """Counts: the arc, the warmth of the ground, trees, and noise."""
    chance = random.Random(round(az_deg * 1000) * 100_003 + round(el_deg * 1000))
    loud = 0.0
    for seen in seen_from(OBSERVER, "radio"):
        far = separation(az_deg, el_deg, seen.az_deg, seen.el_deg) / WIDTH_DEG
        loud += (70.0 + 13.0 * (abs(seen.slot.longitude_deg) % 7)) * math.exp(-4 * math.log(2) * far * far)
    ground = 30.0 / math.sin(math.radians(max(el_deg, 8.0))) / 3.0
    trees = 55.0 / (1.0 + math.exp((el_deg - tree_deg(az_deg)) * 1.6))
    return 400.0 + loud + ground + trees + chance.gauss(0.0, 1.2)


def made(plan=PLAN, heard=None, **other):
    """Return a map of it."""
    about = {"latitude_deg": OBSERVER.latitude_deg, "longitude_deg": OBSERVER.longitude_deg, "dish": "Carryout G2"}
    return made_map(plan, level, heard=heard, about=about, **other)


def keep(path, sky, key=KEY):
    """Write a map into a file as the program does that makes it."""
    new = NewMap(key, sky.plan, sky.source, sky.unit, sky.decibels, sky.demo, sky.about)
    writer = MapWriter(path, new)
    for sample in sky.samples:
        writer.add(sample, {"transponder": "1"})
    writer.close()
    assert not writer.problem
    return path


def task(sky, *, phase=TaskPhase.RUNNING, why="", newest=24, key=KEY, number=1, done=None, **found):
    """Return what the station tells while it makes this map, of which so many directions are the newest."""
    rows = tuple((float(each.cell), each.az_deg, each.el_deg, each.value) for each in sky.samples[-newest:])
    told = {"map": key, "newest": rows, "beyond": 0, **found}
    more = {name: told.pop(name) for name in ("next_at",) if name in told}
    done = len(sky.samples) if done is None else done
    return TaskState(number, "map", "you", phase, 0.0, why, done=done, of=sky.plan.cells, found=told, **more)


def app_with(heard_map, *, under_way=None, key=KEY, **settings):
    """Return the app with this map open, and the task that makes it, if any."""
    app = stand_in.app_in("idle", **settings)
    app.maps.book.read(key, MapRead.of(heard_map))
    if under_way is not None:
        app.station.state = replace(app.station.state, tasks=(under_way,))
    return app


def on_map(test, sky, task=None, *, size=(120, 36), state=None, keys=("f3",), view=True, **settings):
    """Return what `test(app, pilot)` returns on F3 with this map."""

    async def body():
        app = app_with(sky, under_way=task, **settings)
        if state is not None:
            app.station.state = replace(app.station.state, **state)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            for key in keys:
                await pilot.press(key)
                await pilot.pause()
            if view and task is None:
                app.page._show_map()
            await settle(app, pilot)
            return await test(app, pilot)

    return asyncio.run(body())


async def settle(app, pilot):
    app.paint()
    await pilot.pause()
    await pilot.pause()
