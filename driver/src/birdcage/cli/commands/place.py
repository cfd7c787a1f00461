"""`birdcage place`."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli.commands.place_horizon import horizon
from birdcage.cli.exits import DATA_EPILOG, EPILOG
from birdcage.cli.options import find_paths, flags, global_options, load_settings
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among, observer_options

if TYPE_CHECKING:
    from birdcage.gps.fix import GpsFix


@click.group("place", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Say where the dish stands; keep several places, each with its own horizon.

    The active place is [place] of birdcage.toml, which `use` and `gps --use` write. Saved ones are in places.toml.
    """


@command.command("list", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def list_() -> None:
    """Print the saved places; the one in use has a star."""
    from birdcage.base.places import is_in_use, load_places
    from birdcage.cli.place_words import place_line, place_values
    from birdcage.cli.say import say, tell, tell_json

    paths = find_paths()
    here, places = load_settings(paths).place, load_places(paths.places_file)
    for problem in places.problems:
        say(problem)
    if flags().json:
        tell_json([{**place_values(each), "in_use": is_in_use(each, here)} for each in places.entries])
        return
    for each in places.entries:
        tell(f"{'*' if is_in_use(each, here) else ' '} {place_line(each)}")
    if not places.entries:
        say("No place is saved yet: `birdcage place add NAME WHERE`.")


@command.command("show", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def show() -> None:
    """Print the active place."""
    from birdcage.base.errors import ConfigError
    from birdcage.cli.place_words import place_in_use, place_line, place_values
    from birdcage.cli.say import say, tell, tell_json

    settings = load_settings(find_paths())
    for problem in settings.problems:
        say(problem.text)
    place = place_in_use(settings.place)
    if place is None:
        raise ConfigError("No place is set: `birdcage place add NAME WHERE --use`, or `birdcage place gps --use`.")
    if flags().json:
        tell_json(place_values(place))
    else:
        tell(place_line(place))


@command.command("add", short_help="Save a place: a city, a locator, or two angles.", epilog=DATA_EPILOG,
                 context_settings=NEGATIVE_NUMBERS)  # fmt: skip
@click.argument("name")
@click.argument("where", nargs=-1)
@click.option(
    "--horizon", "file", type=click.Path(path_type=Path), metavar="FILE", help="Its horizon, az and el a line."
)
@click.option("--use", "use_it", is_flag=True, help="Make it the active place.")
@observer_options
@global_options("config", "json", "verbose")
def add(
    name: str, where: tuple[str, ...], file: Path | None, use_it: bool, lat: float | None, lon: float | None,
    alt: float | None,
) -> None:  # fmt: skip
    """Save a place. WHERE is `51.9 4.8`, a locator (JO21jv) or a city; without it, the active place is saved.

    A city is known to about a kilometre, and neither it nor a locator tells the height: give --alt. South and west
    are letters or a minus (33.5S 151.2E, -33.5 151.2).
    """
    from birdcage.base.config import edit
    from birdcage.base.places import add_place, checked_place, place_settings
    from birdcage.cli.place_words import find_place, place_in_use, place_line, read_mask
    from birdcage.cli.say import say

    no_options_among((name, *where))
    paths = find_paths()
    latitude, longitude, height_m, points = find_place(load_settings(paths), " ".join(where), lat, lon, alt)
    if file is not None:
        points = read_mask(file).points
    try:
        place = checked_place(name, latitude, longitude, height_m, points)
    except ValueError as error:
        raise click.UsageError(f"{error}.") from None
    add_place(paths.places_file, place)
    say(f"Saved: {place_line(place)}")
    if use_it:
        edit(paths.config_file, place_settings(place))
        say(f"{place.name} is the active place now.")
    elif place_in_use(load_settings(paths).place) is None:
        say(f"No place is active yet: `birdcage place use {shlex.quote(place.name)}` makes it this one.")


@command.command("use", short_help="Make a saved place the active one.", epilog=DATA_EPILOG)
@click.argument("name")
@global_options("config", "json", "verbose")
def use(name: str) -> None:
    """Make a saved place the active one: write it into [place] of birdcage.toml."""
    from birdcage.base.config import edit
    from birdcage.base.places import is_in_use, load_places, place_settings
    from birdcage.cli.place_words import find_saved, place_in_use, place_line
    from birdcage.cli.say import say

    paths = find_paths()
    places = load_places(paths.places_file)
    place = find_saved(places, name)
    here = load_settings(paths).place
    before = place_in_use(here)
    edit(paths.config_file, place_settings(place))
    if before is not None and not any(is_in_use(each, here) for each in places.entries):
        say(f"The place before it was not saved: {place_line(before)}")
    say(f"In use: {place_line(place)}")


@command.command("remove", epilog=DATA_EPILOG)
@click.argument("name")
@global_options("config", "json", "verbose")
def remove(name: str) -> None:
    """Forget a saved place. The active place stays as it is."""
    from birdcage.base.places import load_places, remove_place
    from birdcage.cli.place_words import find_saved
    from birdcage.cli.say import say

    file = find_paths().places_file
    find_saved(load_places(file), name)
    remove_place(file, name)
    say(f"{name} is forgotten.")


@command.command("gps", short_help="Ask a GPS receiver where this is.", epilog=EPILOG)
@click.argument("receiver", required=False)
@click.option("--use", "use_it", is_flag=True, help="Make it the active place.")
@click.option("--name", help="What to call it, with --use.")
@click.option("--baud", "gps_baud", type=click.IntRange(300, 4_000_000), help="Speed of its port.  [default: tried]")
@click.option("--timeout", "timeout_s", type=click.FloatRange(1.0, 3600.0), default=30.0, show_default=True,
              help="Seconds to wait for a fix.")  # fmt: skip
@global_options("config", "json", "verbose")
def gps(receiver: str | None, use_it: bool, name: str | None, gps_baud: int | None, timeout_s: float) -> None:
    """Ask a GPS receiver: gpsd (also gpsd://host:port), or its own port with NMEA (/dev/ttyACM0).

    Without RECEIVER it is `gps` in [place] of birdcage.toml, else gpsd. The port of the dish is never opened.
    """
    from birdcage.base.clock import RealClock
    from birdcage.base.places import Place
    from birdcage.cli.place_words import place_line
    from birdcage.cli.say import iso, say, tell, tell_json
    from birdcage.gps.clock_check import remember
    from birdcage.gps.locate import locate
    from birdcage.gps.verdict import by_gps

    paths = find_paths()
    settings = load_settings(paths)
    receiver = receiver or settings.place.gps or "gpsd"
    fix = locate(receiver, RealClock(), baud=gps_baud, timeout_s=timeout_s, dish_port=settings.dish.port)
    verdict = by_gps(fix)
    if flags().json:
        tell_json({
            "latitude_deg": fix.latitude_deg, "longitude_deg": fix.longitude_deg, "height_m": fix.height_m,
            "utc": iso(fix.utc), "satellites": fix.satellites, "hdop": fix.hdop,
            "clock_offset_s": None if verdict is None else verdict.offset_s, "source": fix.source,
        })  # fmt: skip
    else:
        tell(place_line(Place(name or "GPS", fix.latitude_deg, fix.longitude_deg, fix.height_m or 0.0)))
        used = "-" if fix.satellites is None else fix.satellites
        say(f"By {fix.source}: {used} satellites, HDOP {'-' if fix.hdop is None else f'{fix.hdop:g}'}"
            f"{'' if fix.height_m is not None else ', height not known'}.")  # fmt: skip
        say("The receiver gave no time." if verdict is None else verdict.sentence)
    if verdict is not None:
        remember(paths.state, verdict)
    if use_it:
        _use(fix, name, receiver)


def _use(fix: GpsFix, name: str | None, receiver: str) -> None:
    from birdcage.base.config import edit
    from birdcage.base.places import moved_settings
    from birdcage.cli.say import say

    paths = find_paths()
    here = load_settings(paths).place
    height_m = None if fix.height_m is None else round(fix.height_m, 1)
    changes = moved_settings(here, round(fix.latitude_deg, 6), round(fix.longitude_deg, 6), height_m, name)
    changes["place.gps"] = receiver
    if here.horizon and "place.horizon" in changes:
        say("The horizon was another place's, and is flat now: `birdcage place horizon import`.")
    edit(paths.config_file, changes)
    say("It is the active place now.")


command.add_command(horizon)
