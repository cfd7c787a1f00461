"""`birdcage autotrack`."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.known_satellites import find_elements
from birdcage.cli.options import DEMO_FIRMWARE, NO_DISH, flags, global_options, wanted
from birdcage.cli.sky_options import UTC_TIME, at_option, elements_option, find_observer, observer_options

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.sky.observer import Observer
    from birdcage.sky.watch_source import Watched


@click.command("autotrack", epilog=exits.EPILOG)
@elements_option
@observer_options
@click.option("--dry-run", is_flag=True, help="Only print the schedule.  [default: unless --engage]")
@click.option("--engage", is_flag=True, help="Move the dish: follow one pass after the other, until Ctrl+C.")
@click.option("--until", type=UTC_TIME, help="When --engage ends: no pass begins after it. ISO 8601, UTC.")
@click.option(
    "--speed", type=click.FloatRange(1.0, 1000.0), help="Run time this many times faster; simulated dish only."
)
@at_option("When the list begins.", old_name="--start")
@click.option(
    "--hours", type=click.FloatRange(0.0, 72.0, min_open=True), help="How far ahead.  [default: as set, or 24]"
)
@global_options(firmware=f"{NO_DISH}; with --engage the port is asked")
def command(
    elements: Path | None, lat: float | None, lon: float | None, alt: float | None, dry_run: bool, engage: bool,
    until: datetime | None, speed: float | None, at: datetime | None, hours: float | None,
) -> None:  # fmt: skip
    """Show which passes of the favourites would be followed by themselves, and why the others are left out.

    Higher priorities come first (`birdcage elements favourite NAME --priority N`). Among equals the longest time in
    reach wins. A pass is cut short only for one of higher priority. `[autotrack]` in birdcage.toml sets the least
    elevation and duration. Times and elevations listed are without refraction; following adds it. With --elements every
    satellite of the file counts as a favourite.
    Nothing moves without --engage. With it the dish must be homed, and Ctrl+C stops it. If another birdcage program has
    the port, that one follows, from its own place; if this command ends without Ctrl+C, that goes on.
    """
    from dataclasses import replace
    from datetime import UTC, datetime, timedelta

    from birdcage.cli.autotrack_report import tell_schedule, values_of_schedule
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.standing import limits_of
    from birdcage.cli.table import room
    from birdcage.pursuit.schedule import schedule
    from birdcage.pursuit.schedule_candidates import find_candidates, slewing
    from birdcage.sky.decay import reentry_warning

    if engage and (dry_run or elements or at or hours):
        raise click.UsageError("--dry-run, --elements, --at and --hours move nothing. Leave them out with --engage.")
    if not engage and (until or speed):
        raise click.UsageError("--until and --speed go with --engage.")
    wants = wanted()
    if engage:
        _engage(wants, find_observer(wants.settings, lat, lon, alt), until, speed, elsewhere=lat is not None)
        return
    observer = find_observer(wants.settings, lat, lon, alt)
    watched = _favourites(find_elements(wants.paths, elements, say), from_file=elements is not None)
    begin = at if at is not None else datetime.now(UTC)
    rules = wants.settings.autotrack if hours is None else replace(wants.settings.autotrack, hours=hours)
    if wants.named_model is None:
        say("No dish is named (--firmware, or firmware in birdcage.toml): reach is all above the horizon.")
    limits = limits_of(wants)
    found = find_candidates(watched, observer, limits, begin, rules.hours, wants.paths.downlinks_file)
    rows = schedule(found, rules, slewing(limits), begin)
    until = begin + timedelta(hours=rules.hours)
    never = sum(not each.reach.intervals and each.passing.aos < until for each in found)
    if flags().json:
        tell_json({**values_of_schedule(rows, begin, rules.hours), "never_in_reach": never})
        return
    tell_schedule(rows, begin, rules.hours, room())
    warning = reentry_warning((each, begin) for each in watched.part(sorted(watched.favourites)).elements)
    if warning is not None:
        say(warning)
    if never:
        say(f"{never} more {'pass' if never == 1 else 'passes'} of favourites never come within reach of this dish.")


def _engage(
    wants: Wanted, observer: Observer, until: datetime | None, speed: float | None, *, elsewhere: bool
) -> None:  # fmt: skip
    """Follow the favourites of the catalogue; `elsewhere`: the command line names a place. ConfigError without any."""
    from birdcage.base.clock import RealClock, ScaledClock
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.autotrack_run import HOLDER, run_autotrack
    from birdcage.cli.desk_elsewhere import DeskElsewhere
    from birdcage.sky.watch_source import read_catalogue

    if speed is not None and not wants.port.startswith("sim:"):
        raise click.UsageError(f"--speed is for a simulated dish only. Give --port sim:{DEMO_FIRMWARE} with it.")
    _favourites(read_catalogue(wants.paths.catalogue), from_file=False)
    clock = RealClock() if speed is None else ScaledClock(speed)
    with reach_dish(wants, HOLDER, moves=True, clock=clock, attached=DeskElsewhere) as dish:
        if isinstance(dish, DeskElsewhere) and elsewhere:
            raise click.UsageError(f"{dish.station.via} follows from its own place. Leave out --lat, --lon and --alt.")
        run_autotrack(dish, wants, observer, until, as_json=flags().json)


def _favourites(watched: Watched, *, from_file: bool) -> Watched:
    """Return what counts as favourite. ConfigError if nothing does."""
    from dataclasses import replace

    from birdcage.base.errors import ConfigError

    if from_file:
        return replace(watched, favourites=frozenset(range(len(watched.elements))))
    if not watched.favourites:
        raise ConfigError("No favourites yet. `birdcage elements favourite NAME --priority 1` adds one.")
    return watched
