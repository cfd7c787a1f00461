"""`birdcage sky`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import NO_DISH, flags, global_options
from birdcage.cli.sky_options import at_option, elements_option, find_observer, observer_options

if TYPE_CHECKING:
    from datetime import datetime
    from pathlib import Path

SHOWN = 40
"""Rows of the table unless `--limit` says otherwise."""


@click.command("sky", epilog=DATA_EPILOG)
@at_option("When.")
@click.option(
    "--min-elevation", type=click.FloatRange(-90.0, 90.0), default=0.0, show_default=True, metavar="DEGREES",
    help="Leave out what is lower.",
)  # fmt: skip
@click.option(
    "--limit", type=click.IntRange(min=1), metavar="N", help=f"The N highest.  [default: {SHOWN}; with --json all]"
)
@observer_options
@elements_option
@global_options("firmware", "json", "config", "verbose", firmware=NO_DISH)
def command(
    at: datetime | None, min_elevation: float, limit: int | None,
    lat: float | None, lon: float | None, alt: float | None, elements: Path | None,
) -> None:  # fmt: skip
    """List what is up now, highest first: satellites of the catalogue, well-known slots, Sun, Moon and planets.

    Elevations are without refraction, which `birdcage track` adds. No dish and no network are needed.
    """
    from datetime import UTC, datetime

    from birdcage.cli.known_satellites import frozen_warning, known_satellites
    from birdcage.cli.options import wanted
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.sky_report import look_round, table
    from birdcage.sky.decay import reentry_warning

    dish = wanted()
    observer = find_observer(dish.settings, lat, lon, alt)
    when = at or datetime.now(UTC)
    entries = known_satellites(dish.paths, elements, say)
    up = look_round(entries, observer, when, dish, min_elevation)
    warning = frozen_warning([row.elements for row in up.rows if row.elements is not None])
    down = reentry_warning((row.elements, when) for row in up.rows if row.elements is not None)
    for note in (*up.notes, *filter(None, (warning, down))):
        say(note)
    wanted_rows = limit if limit is not None or flags().json else SHOWN
    rows = up.rows[:wanted_rows]
    if flags().json:
        tell_json([row.values(when) for row in rows])
        return
    for line in table(rows, when):
        tell(line)
    if rows:
        say("Elevations are without refraction.")
    if len(rows) < len(up.rows):
        say(f"{len(up.rows) - len(rows)} more are lower: --limit N shows them.")
    if not rows:
        say(f"Nothing is above {min_elevation:g}° there.")
