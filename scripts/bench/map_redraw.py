"""One redraw of a map of 360 x 60 directions at 160x48, and its floor: the same cells, written without any of the work.

A direction more is heard before each redraw, as it is while a map is made. The floor puts the very signs and inks that
the pane has just drawn into cells, and makes each row ready for the terminal: a screen of as many colours.
"""

from __future__ import annotations

import asyncio
import math
import statistics
import sys
import time
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

from birdcage.skymap.plan import MapPlan
from birdcage.skymap.sky_map import MapSample, SkyMap
from birdcage.station.task_state import TaskPhase, TaskState
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.map_book import MapRead
from birdcage_tui.signal.map_pane import MapPane

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "tui"))

import stand_in

SIZE = (160, 48)
PLAN = MapPlan(0.0, 359.0, 5.0, 64.0, 1.0)
BEGUN = datetime(2026, 3, 20, 6, tzinfo=UTC)
KEY, HEARD, TIMES = "bench", 15_000, 60
AIM_MS = 50.0


@dataclass(frozen=True)
class Redraw:
    """What one redraw takes, in milliseconds: the median, and the slowest."""

    pane_ms: float
    slowest_ms: float
    floor_ms: float

    @property
    def ratio(self) -> float:
        """How many times the floor it takes."""
        return self.pane_ms / self.floor_ms


def _sample(cell: int) -> MapSample:
    az_deg, el_deg = PLAN.at(cell)
    level = 400.0 + 90.0 * math.sin(az_deg / 17.0) * math.cos(el_deg / 9.0) + (cell * 7919 % 23)
    utc = BEGUN + timedelta(seconds=cell)
    return MapSample(
        cell, None, utc, az_deg, el_deg, None, None, level, 1.0, 10, 0.5, None, None, None, 0, "", "slewing",
    )  # fmt: skip


def measure() -> Redraw:
    """Return how long it takes."""
    return asyncio.run(_measured())


async def _measured() -> Redraw:
    cells = PLAN.sequence[: HEARD + TIMES]
    samples = [_sample(cell) for cell in cells]
    about = {"latitude_deg": stand_in.PLACE.latitude_deg, "longitude_deg": stand_in.PLACE.longitude_deg}
    sky = SkyMap(1, PLAN, BEGUN, None, "tuner", "counts", False, True, about, samples=tuple(samples[:HEARD]))
    app = stand_in.app_in("idle")
    app.maps.book.read(KEY, MapRead.of(sky))
    async with app.run_test(size=SIZE) as pilot:
        await pilot.pause()
        await pilot.press("f3", "i")
        app.set_class(False, "-few-colours")  # whatever this terminal is
        app.paint()
        await pilot.pause()
        pane, took, floors = app.query_one(MapPane), list[float](), list[float]()
        for index, sample in enumerate(samples[HEARD:], HEARD + 1):
            rows = ((float(sample.cell or 0), sample.az_deg, sample.el_deg, sample.value),)
            task = TaskState(
                1, "map", "you", TaskPhase.RUNNING, 0.0, "", done=index, of=PLAN.cells,
                found={"map": KEY, "newest": rows, "left_s": 9000.0},
            )  # fmt: skip
            app.station.state = replace(app.station.state, tasks=(task,))
            begin = time.perf_counter()
            app.maps.book.take(task)
            pane.show(app.view())
            took.append(time.perf_counter() - begin)
            floors.append(_floor(pane))
            await pilot.pause()
    return Redraw(statistics.median(took) * 1e3, max(took) * 1e3, statistics.median(floors) * 1e3)


def _floor(pane: MapPane) -> float:
    """Return how long the same cells take, in seconds."""
    drawn = pane._cells  # noqa: SLF001 - the very cells
    assert drawn is not None
    chars, inks = drawn._chars, drawn._inks  # noqa: SLF001
    begin = time.perf_counter()
    cells = Cells(drawn.width, drawn.height)
    for y in range(drawn.height):
        cells.put_row(0, y, chars[y], inks[y])
    inks_by_name = pane.inks
    for y in range(cells.height):
        cells.strip(y, inks_by_name)
    return time.perf_counter() - begin


if __name__ == "__main__":
    found = measure()
    print(
        f"one redraw of {PLAN.columns} x {PLAN.rows} at {SIZE[0]}x{SIZE[1]}: {found.pane_ms:.1f} ms   (aim {AIM_MS:g})"
    )
    print(f"  the slowest of {TIMES}    {found.slowest_ms:.1f} ms")
    print(f"  the same cells alone {found.floor_ms:.1f} ms, ratio {found.ratio:.1f}")
