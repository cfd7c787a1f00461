"""`birdcage autotrack`."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.known_satellites import find_elements
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import UTC_TIME, elements_option, find_observer, observer_options

if TYPE_CHECKING:
    from birdcage.sky.watch_source import Watched


@click.command("autotrack", epilog=exits.EPILOG)
@elements_option
@observer_options
@click.option("--dry-run", is_flag=True, help="Only print. This is all that happens without it, too.")
@click.option("--start", type=UTC_TIME, help="ISO 8601; UTC unless it says its zone.  [default: now]")
@click.option(
    "--hours", type=click.FloatRange(0.0, 72.0, min_open=True), help="How far ahead.  [default: as set, or 24]"
)
@global_options("config", "firmware", "json", "verbose")
def command(
    elements: Path | None, lat: float | None, lon: float | None, alt: float | None, dry_run: bool,  # noqa: ARG001
    start: datetime | None, hours: float | None,
) -> None:  # fmt: skip
    """Show which passes of the favourites would be followed by themselves, and why the others are left out.

    Higher priorities come first (`birdcage elements favourite NAME --priority N`); within one the greatest time within
    reach wins. A pass is cut short only for one of higher priority. `[autotrack]` in birdcage.toml has the least
    elevation and duration. With --elements every satellite of the file counts as a favourite. Nothing moves.
    """
    from dataclasses import replace
    from datetime import UTC, datetime, timedelta

    from birdcage.cli.autotrack_report import tell_schedule, values_of_schedule
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.standing import limits_of
    from birdcage.cli.table import room
    from birdcage.pursuit.schedule import schedule
    from birdcage.pursuit.schedule_candidates import find_candidates, slewing

    wants = wanted()
    observer = find_observer(wants.settings, lat, lon, alt)
    watched = _favourites(find_elements(wants.paths, elements, say), from_file=elements is not None)
    begin = start if start is not None else datetime.now(UTC)
    rules = wants.settings.autotrack if hours is None else replace(wants.settings.autotrack, hours=hours)
    if wants.named_model is None:
        say("No dish is named (--firmware, or firmware in birdcage.toml): reach is all above the horizon.")
    limits = limits_of(wants)
    found = find_candidates(watched, observer, limits, begin, rules.hours)
    rows = schedule(found, rules, slewing(limits), begin)
    until = begin + timedelta(hours=rules.hours)
    never = sum(not each.reach.intervals and each.passing.aos < until for each in found)
    if flags().json:
        tell_json(values_of_schedule(rows, begin, rules.hours, never))
        return
    tell_schedule(rows, begin, rules.hours, room())
    if never:
        say(f"{never} more {'pass' if never == 1 else 'passes'} of favourites never come within reach of this dish.")


def _favourites(watched: Watched, *, from_file: bool) -> Watched:
    """Return what counts as favourite. ConfigError if nothing does."""
    from dataclasses import replace

    from birdcage.base.errors import ConfigError

    if from_file:
        return replace(watched, favourites=frozenset(range(len(watched.elements))))
    if not watched.favourites:
        raise ConfigError("There are no favourites: `birdcage elements favourite NAME --priority 1` marks one.")
    return watched
