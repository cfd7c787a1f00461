"""Puts session and app together, and leaves in order: STOP, port, terminal, last line."""

from __future__ import annotations

import argparse
import sys
from contextlib import ExitStack
from pathlib import Path

from birdcage.base.clock import Clock, RealClock, ScaledClock
from birdcage.base.config import Settings, load
from birdcage.base.paths import Paths, throw_away_paths
from birdcage.station.build import open_session
from birdcage.station.doorbell import Doorbell
from birdcage.station.inhibitor import SleepInhibitor
from birdcage.station.known import list_firmwares, list_ports
from birdcage.station.session import Session

from birdcage_tui.app import BirdcageApp
from birdcage_tui.settings import AppSettings, Place

EXIT_CRASH = 1
EXIT_USAGE = 2
EXIT_NO_LINK = 3

DEMO_PORT = "sim:g2"
DEMO_PLACE = Place(39.1, -95.7, "DEMO, Kansas")
"""Where the simulated dish stands by default: what it hears fits the sky that is drawn."""


def run(options: argparse.Namespace) -> int:
    """Run the app until it is left. Return its exit status."""
    with ExitStack() as stack:
        demo: bool = options.demo
        paths = stack.enter_context(throw_away_paths()) if demo else _paths(options.config)
        settings = load(paths.config_file, {} if demo else None, _flags(options))
        port = DEMO_PORT if demo else settings.dish.port or _likely_port()
        firmware = settings.dish.firmware or "g2"
        if firmware not in list_firmwares():
            print(
                f"This version does not speak {firmware}: it speaks {', '.join(list_firmwares())}. Give --firmware g2.",
                file=sys.stderr,
            )
            return EXIT_USAGE
        clock: Clock = ScaledClock(options.speed) if options.speed else RealClock()
        session = open_session(
            port=port, firmware=firmware, baud=settings.dish.baud, settings=settings, paths=paths,
            clock=clock, survey=not options.skip_init,
        )  # fmt: skip
        if not port.startswith("sim:"):
            stack.callback(Doorbell(session.station, paths.state / "owners").close)
            stack.callback(SleepInhibitor(session.station).close)
        return _run_app(session, settings, demo=demo)


def _run_app(session: Session, settings: Settings, *, demo: bool) -> int:
    place = settings.place
    known = place.latitude_deg is not None and place.longitude_deg is not None
    app = BirdcageApp(
        session,
        AppSettings(
            theme=settings.app.theme,
            place=Place(place.latitude_deg or 0.0, place.longitude_deg or 0.0, place.name or "")
            if known
            else DEMO_PLACE if demo else None,
            tour=demo,
            notice=" ".join(problem.text for problem in settings.problems),
        ),
    )  # fmt: skip
    try:
        app.run()
    finally:
        # Also after an exception: the dish comes first.
        link = session.station.state.link
        farewell = session.close()
    print(farewell)
    if app.return_code:
        return app.return_code
    if link.last_reply is None and link.detail:
        print(link.detail, file=sys.stderr)
        return EXIT_NO_LINK
    return 0


def _paths(config: str | None) -> Paths:
    paths = Paths.default()
    return paths.with_config(Path(config).expanduser()) if config else paths


def _flags(options: argparse.Namespace) -> dict[str, object]:
    return {
        "dish.port": options.port, "dish.firmware": options.firmware, "dish.baud": options.baud,
        "app.theme": options.theme,
    }  # fmt: skip


def _likely_port() -> str:
    """Return the first port with a USB identity, else the usual name: the app then says that it is not there."""
    return next((port.device for port in list_ports() if port.identity), "/dev/ttyUSB0")
