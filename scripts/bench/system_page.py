"""F4 on the wire and on the screen: the lines of a first visit, what a hidden page sends, how long a filter takes.

The peer of a first visit is its own exchanges: each question of the tab once, each menu entered once, and the way back.
The peer of a filter is one drawing of the same rows at the same size, without any filter.
"""

from __future__ import annotations

import asyncio
import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path

from birdcage.rotator.feature import FeaturePage
from birdcage.rotator.own_settings import SettingRow, SettingsTable
from birdcage_tui.shown.own_settings import OwnSettingsNow
from birdcage_tui.shown.system_sheet import features_on
from birdcage_tui.system.own_settings_pane import OwnSettingsPane

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "tui")]

import stand_in  # noqa: E402 - the path comes first
from test_end_to_end import House, press  # noqa: E402

TABS = {"b": FeaturePage.HARDWARE, "m": FeaturePage.MOTORS, "d": FeaturePage.RECEIVER}
BACK = 2
"""Leaving the last menu, and entering the motors'."""
ROWS, TIMES = 150, 40
WORDS = "minimum el"


def least(house: House, page: FeaturePage) -> int:
    """Return how many lines a first visit needs."""
    readings = house.station.state.readings
    wanted = [
        each for each in features_on(house.station.state.dish, page)
        if each.is_readable and not each.read_hazard and each.id not in readings
    ]  # fmt: skip
    asked = {each.asked: each.cost.lines if each.asked.endswith("15") else 1 for each in wanted}
    asked |= {each.asked: 2 for each in wanted if each.asked.split()[-1] in ("agc", "snr", "nid", "lnbv")}
    menus = {each.cost.menu for each in wanted} - {"mot"}
    return sum(asked.values()) + 2 * len(menus) + (BACK if menus else 0)


async def visits() -> None:
    """Print the lines of each first visit, and what is sent while the page is hidden."""
    house = House()
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await house.step(3)
        await press(house, "f4")
        await house.step(6)
        for key, page in TABS.items():
            wants, since = least(house, page), house.clock.monotonic()
            await press(house, key)
            for _ in range(200):
                await house.step(0.1)
                if house.app.system.sheets.is_settled:
                    break
            sent = [line for at, line in house.device.shell.received if at >= since and line not in ("a", "")]
            print(f"{page.value:9} first visit {len(sent):3} lines, needed {wants:3}: {len(sent) / wants:.2f}")
        await press(house, "f2")
        await house.step(6)
        since = house.clock.monotonic()
        await house.step(60)
        sent = [line for at, line in house.device.shell.received if at >= since and line not in ("a", "")]
        print(f"hidden for 60 s: {len(sent)} lines besides the position")


async def filters() -> None:
    """Print how long it takes from a letter in the filter to its rows."""
    app = stand_in.app_in("idle")
    async with app.run_test(size=(160, 48)) as pilot:
        await pilot.press("f4", "n")
        await pilot.pause()
        rows = {n: SettingRow(n, f"Minimum Elevation {n}", "1.00", "1.00", "1.00") for n in range(ROWS)}
        app.system.own_settings.now = OwnSettingsNow(SettingsTable(("",), rows), app.session.clock.monotonic())
        pane, taken, floor = app.query_one(OwnSettingsPane), list[float](), list[float]()
        for number in range(TIMES):
            view = replace(app.view(), now=float(number))
            for words, times in ((WORDS + str(number % 10), taken), ("", floor)):
                pane.filter = words
                begun = time.perf_counter()
                pane.show(view)
                times.append((time.perf_counter() - begun) * 1000.0)
        one, other, frame_ms = statistics.median(taken), statistics.median(floor), 1000.0 / app.settings.update_hz
        print(f"filter of {ROWS} rows: {one:.2f} ms, {one / other:.2f} of a drawing, {one / frame_ms:.3f} of a frame")


if __name__ == "__main__":
    asyncio.run(visits())
    asyncio.run(filters())
