"""The real demo on a virtual clock, driven key by key: what pictures are taken of."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from uuid import uuid4

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "tui"))

import jumping_loop
import picture
import stand_in
from birdcage.base.background import BackgroundWriter
from birdcage.base.clock import VirtualClock
from birdcage.base.config import LinkSettings, PlaceSettings, Settings, load
from birdcage.base.config.tracking_sections import RadioSettings, TrackingSettings
from birdcage.base.paths import Paths, throw_away_paths
from birdcage.diagnostics.motor_test_records import MotorTestBook
from birdcage.diagnostics.motor_test_task import MotorTests
from birdcage.setup.engine import Setup
from birdcage.signal.source_set import SourceSet
from birdcage.skymap.map_keeper import MapKeeper
from birdcage.skymap.map_task import map_tasks
from birdcage.station.build import open_session
from birdcage.station.known import SystemFacts
from birdcage_tui.demo import DEMO_DELAY_S, DEMO_PARK, DEMO_PLACE, demo_port, name_demo, remember_demo
from birdcage_tui.drawing.themes import LOOKS
from birdcage_tui.feeds.calibrate_source import make_calibrate
from birdcage_tui.feeds.demo_radio import radio_flags, write_downlinks
from birdcage_tui.feeds.horizon_file import ConfigHorizon
from birdcage_tui.feeds.ready_watch import KeptSteps
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.feeds.track_source import make_track
from birdcage_tui.shell.birdcage_app import BirdcageApp
from textual.pilot import Pilot

STEP_S = 0.1
FINE_S, COARSE_S = 2.0, 0.5
"""The end of a longer wait is played as a person sees it, what comes before in longer steps."""
os.environ |= {"COLORTERM": "truecolor", "TERM": "xterm-256color"}  # a map has colours where a terminal does
START = datetime(2026, 3, 20, 15, 30, tzinfo=UTC)
"""When every picture begins: the same sky each time."""
HERE = Settings(
    link=LinkSettings(delay_s=DEMO_DELAY_S),
    place=PlaceSettings(
        name=DEMO_PLACE.name, latitude_deg=DEMO_PLACE.latitude_deg, longitude_deg=DEMO_PLACE.longitude_deg
    ),
    tracking=TrackingSettings(park_az_deg=DEMO_PARK[0], park_el_deg=DEMO_PARK[1]),
)
"""What the setup of the demo knows of the place."""
Rows = list[list[tuple[str, object]]]


def make_repeatable() -> None:
    """Have this process take the same pictures each time: by a clock that jumps, with files written at once.

    Else a slow machine meets another order of timers and keys.
    """
    jumping_loop.let_time_jump()
    offer = BackgroundWriter.offer

    def offer_and_flush(writer: BackgroundWriter[object], item: object) -> bool:
        taken = offer(writer, item)
        writer.flush()
        return taken

    BackgroundWriter.offer = offer_and_flush  # type: ignore[method-assign]


def rows_of(app: BirdcageApp) -> Rows:
    """Return what stands on the screen, cell by cell."""
    strips = app.screen._compositor.render_strips()  # noqa: SLF001 - the only way to the cells
    return [[(segment.text, segment.style) for segment in strip] for strip in strips]


class Stage:
    """One app, its dish, and the keys pressed on it."""

    def __init__(self, app: BirdcageApp, pilot: Pilot[None], paths: Paths) -> None:
        self.app, self.pilot, self.paths = app, pilot, paths

    async def wait(self, seconds: float) -> None:
        """Let so much time of the dish pass."""
        left_s = max(seconds, STEP_S)
        while left_s > STEP_S / 2.0:
            step_s = COARSE_S if left_s > FINE_S + COARSE_S else STEP_S
            left_s -= step_s
            self.app.session.step(step_s)
            self._work()
            await self.pilot.pause()
            self.app._tick()  # noqa: SLF001 - its timer runs in real time
        self.app.feeds.ready.tally()
        for _ in range(3):  # a question under way, the one that this very moment asks, and its answer
            self.app.paint()
            await self.pilot.pause()
            self._work()
            await self.pilot.pause()

    def _work(self) -> None:
        for feed in (self.app.sky, self.app.track, self.app.calibrate):
            if feed.source is not None:
                feed.source.step()

    async def press(self, *keys: str) -> None:
        """Press keys, and let what they ask for begin."""
        for key in keys:
            await self.pilot.press(key)
            await self.wait(STEP_S)

    async def type(self, text: str) -> None:
        """Type into what has the focus."""
        await self.pilot.press(*("space" if char == " " else char for char in text))
        await self.pilot.pause()

    def svg(self) -> str:
        """Return the picture of the screen."""
        return picture.svg(rows_of(self.app), LOOKS[self.app.theme].ground)

    def text(self) -> str:
        """Return what a person reads."""
        return stand_in.text_of(self.app)


def radio_of(paths: Paths, dish: str) -> RadioSettings:
    """Return the settings of the demo's receiver."""
    flags = radio_flags(paths, dish)
    return load(paths.config_file, environ={}, flags=flags).radio


@asynccontextmanager
async def demo(
    size: tuple[int, int], theme: str = "dusk", *, tour: bool = False, firmware: str = "g2"
) -> AsyncIterator[Stage]:
    """Open the demo at a size; nothing of yours is touched."""
    with throw_away_paths() as paths:
        clock = VirtualClock(START)
        dish = f"stage-{uuid4().hex[:8]}"
        here = replace(HERE, radio=radio_of(paths, dish))
        write_downlinks(paths)
        remember_demo(paths, firmware)
        signals = SourceSet(here, clock, threads=False)
        maps = MapKeeper(signals, paths.signal_recordings, here)
        motors = MotorTests(MotorTestBook(paths.journal))
        session = open_session(
            port=demo_port(firmware, dish), firmware=firmware, baud=None, settings=here, paths=paths, clock=clock,
            identify=name_demo, tasks={**signals.tasks, **map_tasks(maps), **motors.tasks},
            on_close=motors.book.close,
        )  # fmt: skip
        signals.attach(session.station)
        maps.attach(session.station)
        motors.attach(session.station)
        session.start = lambda: None  # stepped here instead of running on its thread
        settings = AppOptions(
            theme=theme,
            cell_aspect=picture.CELL_ASPECT,
            place=DEMO_PLACE,
            tour=tour,
            presets_file=paths.presets_file,
            recordings_file=paths.signal_recordings,
            levels_file=paths.known_levels,
            backups_folder=paths.backups,
            journal_file=paths.journal,
            setup_steps=KeptSteps(session, lambda: here, paths).count,
            setup=lambda: Setup(session, here, paths, environ={}, ports=list, system=SystemFacts),
            sky=make_sky(here, paths, clock, demo=True, threads=False),
            track=make_track(session, here, lambda: here, paths, demo=True, signals=signals, threads=False),
            signal=signals,
            calibrate=make_calibrate(session, lambda: here, paths, environ={}, threads=False),
            horizon=ConfigHorizon(paths, here, lambda: load(paths.config_file, environ={})),
        )
        app = BirdcageApp(session, settings)
        app.feeds.maps.beside = app.feeds.system.health.beside = lambda work: work()
        async with app.run_test(size=size) as pilot:
            yield Stage(app, pilot, paths)
        session.close()
        await asyncio.sleep(0)
