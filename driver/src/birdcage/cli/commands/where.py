"""`birdcage where`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import NO_DISH, flags, global_options
from birdcage.cli.sky_options import (
    NEGATIVE_NUMBERS,
    at_option,
    elements_option,
    find_observer,
    no_options_among,
    observer_options,
)

if TYPE_CHECKING:
    from datetime import datetime
    from pathlib import Path


@click.command("where", epilog=DATA_EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1, required=True)
@at_option("When.")
@observer_options
@elements_option
@global_options("firmware", "json", "config", "verbose", firmware=NO_DISH)
def command(
    target: tuple[str, ...], at: datetime | None,
    lat: float | None, lon: float | None, alt: float | None, elements: Path | None,
) -> None:  # fmt: skip
    """Print where TARGET stands: look angle, range, rates, and what to expect there.

    TARGET is a satellite by name or number (iss, AO-91, 25544), or sun, moon, a planet, polaris, cas a. Places on the
    arc are 28.2E, dish 119, QO-100. Directions are ra=5h34m,dec=+22d; gal 120,-5; 180 45; az 180 el -3.
    Azimuth and elevation are without refraction; how much `birdcage track` adds stands beside them. No dish and no
    network are needed.
    """
    from datetime import UTC, datetime

    from birdcage.cli.named_target import find_target, tell_below
    from birdcage.cli.options import wanted
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.where_report import Report

    no_options_among(target)
    dish = wanted()
    observer = find_observer(dish.settings, lat, lon, alt)
    found, when = find_target(target, dish.paths, elements, say), at or datetime.now(UTC)
    report = Report.of(found.target, observer, when, dish)
    tell_below(found.target, observer, when, say)
    if flags().json:
        tell_json({**report.values(), "silent_since": found.silent_since})
    else:
        for line in report.lines():
            tell(line)
