"""Builds the session and runs the app over it; whatever ends the app, the dish is stopped and the port closed."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TextIO
from uuid import uuid4

from birdcage.base.clock import Clock, RealClock, ScaledClock
from birdcage.base.config import Settings, load
from birdcage.base.config.edit import edit
from birdcage.base.errors import BirdcageError
from birdcage.base.log_output import LogOutput
from birdcage.base.paths import Paths, throw_away_paths
from birdcage.base.second_dish import second_dish
from birdcage.base.signals import SignalListener
from birdcage.diagnostics.motor_test_records import MotorTestBook
from birdcage.diagnostics.motor_test_task import MotorTests
from birdcage.setup.first_run import is_first_run
from birdcage.signal.source_set import SourceSet
from birdcage.skymap.map_keeper import MapKeeper
from birdcage.skymap.map_task import map_tasks
from birdcage.station.access import FaceSession
from birdcage.station.build import open_session
from birdcage.station.control_client import owners_folder
from birdcage.station.known import list_firmwares, list_ports
from birdcage.station.services import Services
from birdcage.station.session import Session

from birdcage_tui.chosen_dish import second_demo_paths, take_chosen
from birdcage_tui.demo import DEMO_DELAY_S, DEMO_FIRMWARE, DEMO_PARK, DEMO_PLACE, demo_port, name_demo, remember_demo
from birdcage_tui.drawing.glyphs import fitting
from birdcage_tui.drawing.terminal_cells import ASPECT
from birdcage_tui.feeds.calibrate_source import make_calibrate
from birdcage_tui.feeds.clock_watch import make_check
from birdcage_tui.feeds.horizon_file import ConfigHorizon
from birdcage_tui.feeds.map_lessons import MapLessons
from birdcage_tui.feeds.network_source import StationNetwork
from birdcage_tui.feeds.ready_watch import KeptChecks, KeptSteps
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.feeds.tone_sound import find_sound
from birdcage_tui.feeds.track_source import follow_there, make_track
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace

if TYPE_CHECKING:
    from birdcage.station.attached_session import AttachedSession

    from birdcage_tui.feeds.setup_engine import SetupEngine

PROGRAM = "birdcage-tui"
"""How this program is called in others."""
LEAVE_S = 1.0
"""How long the end may wait for what is followed to be remembered, a pass to be logged, a receiver to be told LOS."""
QUIT_S = 6.0
"""How long the end may take after the app has left the screen, changed speeds put back included."""
EXIT_ERROR = 1
EXIT_FAULT = 70
"""A fault of birdcage itself, as `birdcage` has it."""


def run(options: argparse.Namespace) -> int:
    """Run the app until a person or a signal ends it. Return the exit status."""
    with ExitStack() as stack:
        signals = SignalListener()
        stack.callback(signals.close)
        signals.start()
        output = LogOutput()
        stack.callback(lambda: print(problem, file=sys.stderr) if (problem := output.close()) else None)
        try:
            output.set(file=None if options.log is None else Path(options.log))
            paths = _paths(options, stack)
        except BirdcageError as wrong:
            return _complain(wrong)
        anew: int | None = None
        while True:
            status, anew = _run_once(options, paths, signals, anew=anew)
            if anew is None:
                return signals.status(status)
            take_chosen(options, paths, anew)


def _complain(wrong: BirdcageError) -> int:
    print(f"birdcage-tui: {wrong}", file=sys.stderr)
    return EXIT_ERROR


def _run_once(
    options: argparse.Namespace, paths: Paths, signals: SignalListener, *, anew: int | None
) -> tuple[int, int | None]:
    """Run the app over one session of each dish. Return the exit status, and which dish it is to begin again with.

    `anew`: another firmware was chosen in the setup of this dish, from 1, which goes on there.
    """
    with ExitStack() as stack:
        try:
            built = _build_all(options, paths)
        except BirdcageError as wrong:
            return _complain(wrong), None
        (session, settings), *also = (
            (each, replace(its, first_page="setup") if number == anew else its)
            for number, (each, its, _) in enumerate(built, 1)
        )
        app = BirdcageApp(session, settings, *also)
        if anew is not None:
            app.begin_with(anew)
        for each, its_settings, services in built:
            _serve(each, its_settings, services, owners_folder(paths), stack, demo=options.demo)
        app.ending.take_signal = signals.take
        signals.tell(app.ending.by_signal, lambda: _end_stuck(app))
        try:
            app.run()
        finally:
            signals.leave(QUIT_S)
            farewell = _finish(app)
        if app.ending.anew is not None and signals.number is None:
            return 0, app.ending.anew
        say_last(farewell)
        return _status(app), None


def _serve(
    session: FaceSession, settings: AppOptions, services: Services, folder: Path, stack: ExitStack, *, demo: bool
) -> None:
    """Let other programs reach a dish of this one, until the stack is left, and close then what was made for it."""
    if not demo and isinstance(session, Session):
        from birdcage.station.control_server import ControlServer
        from birdcage.station.inhibitor import SleepInhibitor

        # `birdcage stop` in another terminal calls here; and a suspended program stops nothing.
        control = ControlServer(session.station, folder, PROGRAM, session.on_wire, services)
        stack.callback(control.close)
        stack.callback(SleepInhibitor(session.station).close)
    if settings.network is not None:
        stack.callback(settings.network.close)
    if settings.signal is not None:
        stack.callback(settings.signal.close_meters)


def _finish(app: BirdcageApp) -> str:
    """End the session; return where the dish is, and what goes on in another program, as a sentence."""
    # First of all the dishes: STOP goes out here if one of ours moves, whatever ended the app.
    return app.dishes.end("quit", LEAVE_S)


def _end_stuck(app: BirdcageApp) -> None:
    """Do what must not be left out, in place of a main thread that does not leave the screen."""
    farewell = _finish(app)
    if app.restore_terminal():
        say_last(farewell)


def _status(app: BirdcageApp) -> int:
    """Return the exit status of an app that has ended without a signal."""
    crash = app.dishes.crash
    if crash is not None:
        say_last(f"birdcage-tui: internal error: {type(crash).__name__}: {crash}", sys.stderr)
        return EXIT_FAULT
    # Textual leaves no status where its own threads ended it, and 1 after an error of ours, which it has printed.
    return EXIT_FAULT if app.fault is not None or app.return_code is None else app.return_code


def say_last(words: str, stream: TextIO | None = None) -> None:
    """Print a last line, on stdout by default; the terminal may be gone, and then the exit status has to stay."""
    stream = stream or sys.stdout
    try:
        print(words, file=stream, flush=True)
    except OSError:
        # Python would try again at the end, and make the status 120.
        with suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _paths(options: argparse.Namespace, stack: ExitStack) -> Paths:
    """Return where files live: for the demo a folder that is gone afterwards."""
    paths = stack.enter_context(throw_away_paths()) if options.demo else Paths.default()
    if options.config is not None:
        if not Path(options.config).is_file():
            raise BirdcageError(f"{options.config} (--config) is not a file.")
        return paths.with_config(Path(options.config))
    return paths


Built = tuple[FaceSession, AppOptions, Services]
"""A session, what the app is shown with, and what programs that are attached to it can join."""


def _build_all(options: argparse.Namespace, paths: Paths) -> list[Built]:
    """Return the dish, and with `--also` the second one: by a `birdcage.toml` of its own, in the demo simulated too."""
    first = _build(options, paths)
    if options.also is None:
        return [first]
    its = argparse.Namespace(**{**vars(options), "port": None, "firmware": None, "baud": None})
    if options.demo:
        its.firmware = options.also
        own = second_demo_paths(paths)
    else:
        its.config = options.also
        own, _ = second_dish(paths, options.also, first[0].station.state.port)
    return [first, _build(its, own, first[0].clock if options.demo else None, number=2)]


def _build(options: argparse.Namespace, paths: Paths, clock: Clock | None = None, number: int = 1) -> Built:
    """Build one dish of the app; those of a demo have one clock. Variables of the environment are for the first."""
    clock = clock or (RealClock() if options.speed is None else ScaledClock(options.speed))
    environ: dict[str, str] | None = {} if options.demo or number > 1 else None
    demo_firmware = _known(options.firmware or DEMO_FIRMWARE) if options.demo else ""
    # Of its own, as there may be more than one demo in a process, each with a clock of its own.
    dish = f"demo-{uuid4().hex[:8]}"
    flags = {
        "dish.port": demo_port(demo_firmware, dish) if options.demo else options.port,
        "dish.firmware": demo_firmware if options.demo else options.firmware,
        "dish.baud": None if options.demo else options.baud,
        "link.delay_s": DEMO_DELAY_S if options.demo else None,
        "place.name": DEMO_PLACE.name if options.demo else None,
        "place.latitude_deg": DEMO_PLACE.latitude_deg if options.demo else None,
        "place.longitude_deg": DEMO_PLACE.longitude_deg if options.demo else None,
        "tracking.park_az_deg": DEMO_PARK[0] if options.demo else None,
        "tracking.park_el_deg": DEMO_PARK[1] if options.demo else None,
        "app.theme": options.theme,
        "app.glyphs": options.glyphs,
    }
    if options.demo:
        from birdcage_tui.feeds.demo_radio import radio_flags, write_downlinks

        flags |= radio_flags(paths, dish)
        remember_demo(paths, demo_firmware, number)
        write_downlinks(paths)
    settings = load(paths.config_file, environ=environ, flags=flags)

    def make_setup() -> SetupEngine:
        from birdcage.setup.engine import Setup

        # The demo offers no port of this machine: a single key would open it.
        ports = list if options.demo else list_ports
        return Setup(session, load_again(), paths, environ=environ, flags=flags, ports=ports)

    def load_again() -> Settings:
        return load(paths.config_file, environ=environ, flags=flags)

    sources = SourceSet(settings, clock, load_again, memory=paths.found_directions,
                        keep=lambda changes: edit(paths.config_file, changes))  # fmt: skip
    maps = MapKeeper(sources, paths.signal_recordings, settings)
    motors = MotorTests(MotorTestBook(paths.journal))
    attached = None if options.demo else _attach(paths, settings.dish.port)
    session: FaceSession
    if attached is not None:
        session, unset = attached, False
    else:
        port = settings.dish.port or _only_port()
        firmware = settings.dish.firmware or _detect(port, settings.dish.baud)
        session = own = open_session(
            port=port,
            firmware=_known(firmware or DEMO_FIRMWARE),
            baud=settings.dish.baud,
            settings=settings,
            paths=paths,
            clock=clock,
            survey=not options.skip_init,
            identify=partial(name_demo, number=number) if options.demo else None,
            load=load_again,
            tasks={**sources.tasks, **map_tasks(maps), **motors.tasks},
            on_close=motors.book.close,
        )
        # A first run begins with the setup, and so does one without a port, or with a dish that did not tell what it
        # is: nothing else can be done there.
        unset = not port or firmware is None or is_first_run(settings, paths)

    def keep_place(latitude_deg: float, longitude_deg: float, height_m: float, name: str) -> None:
        from birdcage.base.config import edit
        from birdcage.base.places import moved_settings

        here = load_again().place
        changes = moved_settings(here, latitude_deg, longitude_deg, height_m or None, name or None)
        edit(paths.config_file, {**changes, "place.declination_deg": None})
        for given in [dotted for dotted in flags if dotted.startswith("place.")]:
            del flags[given]  # what a person says here counts over what was given at the start

    sources.attach(session.station)
    maps.attach(session.station)
    motors.attach(session.station)
    network, services = None, Services()
    if attached is not None:
        track = follow_there(attached.station)
    else:
        network = StationNetwork(own.station, clock, paths, load_again)
        if settings.rotctld.in_app:
            network.switch()  # what is wrong with it is a warning, and shown
        track = make_track(own, settings, load_again, paths, demo=options.demo, signals=sources, services=services)
    shown = replace(
        _app_settings(settings, paths, demo=options.demo, unheeded=_unheeded(options) if attached else ""),
        tour=options.demo and number == 1,
        setup=make_setup,
        setup_steps=KeptSteps(session, load_again, paths).count,
        sky=make_sky(settings, paths, clock, demo=options.demo),
        track=track,
        signal=sources,
        network=network,
        calibrate=make_calibrate(session, load_again, paths, environ=environ, flags=flags),
        horizon=ConfigHorizon(paths, settings, load_again),
        lessons=MapLessons(load_again, paths, thrown_away=options.demo and options.config is None),
        clock_check=make_check(clock, paths),
        ready=None if options.demo else KeptChecks(load_again, paths, clock),  # a demo lacks nothing
        keep_place=keep_place,
        first_page="setup" if unset and not options.demo else "dashboard",
    )
    return session, shown, services


def _attach(paths: Paths, named: str | None) -> AttachedSession | None:
    """Attach to the program that has the port; without a named port, to the only program that has one."""
    from birdcage.station.control_client import find_owners, owners_folder

    owners = find_owners(owners_folder(paths))
    port = named or (owners[0].port if len(owners) == 1 else "")
    if not owners or not port:
        return None
    from birdcage.station.attached_session import attach_session

    return attach_session(paths, port, PROGRAM)


def _only_port() -> str:
    """Return the one USB adapter that is plugged in, without a named port; empty if that is not obvious."""
    adapters = [port.device for port in list_ports() if port.identity is not None]
    return adapters[0] if len(adapters) == 1 else ""


def _detect(port: str, baud: int | None) -> str | None:
    """Return the firmware that answers on a port where none was named; None if that cannot be told.

    Before the first frame: a session speaks one firmware from its first byte on.
    """
    if not port:
        return None
    from birdcage.detection.detecting import detect_firmware

    return detect_firmware(port, RealClock(), baud=baud, tell=lambda words: print(words, file=sys.stderr)).firmware


def _known(named: str) -> str:
    """Return the firmware. BirdcageError for one that this version does not speak; the console proves the others."""
    known = list_firmwares()
    if named not in known:
        raise BirdcageError(f"This version does not support {named}. Use --firmware with one of {', '.join(known)}.")
    return named


def _unheeded(options: argparse.Namespace) -> str:
    """Say which options do not count where another program drives the dish; empty for none."""
    given = [f"--{name.replace('_', '-')}" for name in ("firmware", "baud", "skip_init") if getattr(options, name)]
    if not given:
        return ""
    return f"▲ {', '.join(given)}: without effect here. The program that has the port was started with its own."


def _app_settings(settings: Settings, paths: Paths, *, demo: bool, unheeded: str = "") -> AppOptions:
    place = settings.place
    here = None
    if place.latitude_deg is not None and place.longitude_deg is not None:
        here = SitePlace(place.latitude_deg, place.longitude_deg, place.name or "")
    notice = settings.problems[0].text if settings.problems else unheeded
    chosen = "app.glyphs" in settings.sources
    return AppOptions(
        theme=settings.app.theme,
        keep_theme=lambda name: edit(paths.config_file, {"app.theme": name}),
        map_colours=settings.app.map_colours,
        keep_map_colours=lambda name: edit(paths.config_file, {"app.map_colours": name}),
        place=here,
        tour=demo,
        notice=notice,
        history_file=paths.history,
        logs_folder=paths.logs,
        presets_file=paths.presets_file,
        recordings_file=paths.signal_recordings,
        levels_file=paths.known_levels,
        backups_folder=paths.backups,
        journal_file=paths.journal,
        sound=lambda: find_sound(os.environ, shutil.which),
        glyphs=settings.app.glyphs if chosen else fitting(os.environ),
        cell_aspect=settings.app.cell_aspect or ASPECT,
        cell_aspect_set=settings.app.cell_aspect is not None,
        update_hz=settings.app.update_hz,
    )
