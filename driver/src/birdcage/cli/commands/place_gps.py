"""`birdcage place gps`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import find_paths, flags, global_options, load_settings

if TYPE_CHECKING:
    from birdcage.gps.fix import GpsFix


@click.command("gps", short_help="Ask a GPS receiver where this is.", epilog=EPILOG)
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
