"""Builds the session and runs the app over it; whatever ends the app, the dish is stopped and the port closed."""

from __future__ import annotations

import argparse
import os
import sys
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

from birdcage.base.clock import Clock, RealClock, ScaledClock
from birdcage.base.config import Settings, load
from birdcage.base.errors import BirdcageError
from birdcage.base.paths import Paths, throw_away_paths
from birdcage.setup.engine import Setup, is_first_run
from birdcage.station.build import open_session
from birdcage.station.doorbell import Doorbell
from birdcage.station.inhibitor import SleepInhibitor
from birdcage.station.known import list_firmwares, list_ports
from birdcage.station.ring import owners_folder
from birdcage.station.session import Session

from birdcage_tui.app import BirdcageApp
from birdcage_tui.glyphs import fitting
from birdcage_tui.settings import AppSettings, Place
from birdcage_tui.setup.engine import SetupEngine

DEMO_PLACE = Place(39.1, -95.7, "EM29, demo")
DEMO_PORT = f"sim:g2?lat={DEMO_PLACE.latitude_deg}&lon={DEMO_PLACE.longitude_deg}"
EXIT_ERROR = 1


def run(options: argparse.Namespace) -> int:
    """Run the app until a person leaves it. Return the exit status."""
    with ExitStack() as stack:
        try:
            paths = _paths(options, stack)
            session, settings = _build(options, paths)
        except BirdcageError as wrong:
            print(f"birdcage-tui: {wrong}", file=sys.stderr)
            return EXIT_ERROR
        app = BirdcageApp(session, settings)
        if not options.demo:
            # `birdcage stop` in another terminal rings here; and a suspended program stops nothing.
            stack.callback(Doorbell(session.station, owners_folder(paths)).close)
            stack.callback(SleepInhibitor(session.station).close)
        try:
            app.run()
        finally:
            # First of all the dish: STOP goes out here if it moves, whatever ended the app.
            farewell = session.close()
        print(farewell)
        return app.return_code or 0


def _paths(options: argparse.Namespace, stack: ExitStack) -> Paths:
    """Return where files live: for the demo a folder that is gone afterwards."""
    paths = stack.enter_context(throw_away_paths()) if options.demo else Paths.default()
    if options.config is not None:
        if not Path(options.config).is_file():
            raise BirdcageError(f"{options.config} (--config) is no file.")
        return paths.with_config(Path(options.config))
    return paths


def _build(options: argparse.Namespace, paths: Paths) -> tuple[Session, AppSettings]:
    clock: Clock = RealClock() if options.speed is None else ScaledClock(options.speed)
    flags = {
        "dish.port": DEMO_PORT if options.demo else options.port,
        "dish.firmware": "g2" if options.demo else options.firmware,
        "dish.baud": None if options.demo else options.baud,
        "place.name": DEMO_PLACE.name if options.demo else None,
        "place.latitude_deg": DEMO_PLACE.latitude_deg if options.demo else None,
        "place.longitude_deg": DEMO_PLACE.longitude_deg if options.demo else None,
        "app.theme": options.theme,
        "app.glyphs": options.glyphs,
    }
    settings = load(paths.config_file, environ={} if options.demo else None, flags=flags)
    port = settings.dish.port or _only_port()
    session = open_session(
        port=port,
        firmware=_firmware(settings.dish.firmware),
        baud=settings.dish.baud,
        settings=settings,
        paths=paths,
        clock=clock,
        survey=not options.skip_init,
    )
    # A first run begins with the setup, and so does one without a port: nothing else can be done there.
    begin = "setup" if not options.demo and (not port or is_first_run(settings, paths)) else "dashboard"

    def make_setup() -> SetupEngine:
        # The demo offers no port of this machine: a single key would open it.
        ports = list if options.demo else list_ports
        return Setup(session, settings, paths, environ={} if options.demo else None, flags=flags, ports=ports)

    app_settings = _app_settings(settings, paths, demo=options.demo)
    return session, replace(app_settings, setup=make_setup, first_page=begin)


def _only_port() -> str:
    """Return the one USB adapter that is plugged in, when nobody named a port; empty where that is not obvious."""
    adapters = [port.device for port in list_ports() if port.identity is not None]
    return adapters[0] if len(adapters) == 1 else ""


def _firmware(named: str | None) -> str:
    """Return the firmware to speak: the one named, or the only one there is. The console proves it, or says not."""
    known = list_firmwares()
    if named is None and len(known) == 1:
        return known[0]
    if named not in known:
        what = "Say which firmware the dish has" if named is None else f"This version does not speak {named}"
        raise BirdcageError(f"{what}: --firmware, one of {', '.join(known)}.")
    return named


def _app_settings(settings: Settings, paths: Paths, *, demo: bool) -> AppSettings:
    place = settings.place
    here = None
    if place.latitude_deg is not None and place.longitude_deg is not None:
        here = Place(place.latitude_deg, place.longitude_deg, place.name or "")
    notice = settings.problems[0].text if settings.problems else ""
    chosen = "app.glyphs" in settings.sources
    return AppSettings(
        theme=settings.app.theme,
        place=here,
        tour=demo,
        notice=notice,
        history_file=paths.history,
        logs_folder=paths.logs,
        presets_file=paths.presets_file,
        glyphs=settings.app.glyphs if chosen else fitting(os.environ),
        update_hz=settings.app.update_hz,
    )
