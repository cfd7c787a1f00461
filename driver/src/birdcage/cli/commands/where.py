"""`birdcage where`."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import flags, global_options
from birdcage.cli.sky_options import (
    NEGATIVE_NUMBERS,
    UTC_TIME,
    elements_option,
    find_observer,
    no_options_among,
    observer_options,
)

if TYPE_CHECKING:
    from datetime import datetime
    from pathlib import Path

TEXT_WIDTH = 72
"""Of an error, which click begins with a word of its own: it fits on eighty columns."""


@click.command("where", epilog=DATA_EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1, required=True)
@click.option("--at", type=UTC_TIME, help="Another time than now, UTC unless it names a zone.")
@observer_options
@elements_option
@global_options("firmware", "json", "config", "verbose", firmware="none, and no limits of the dish")
def command(
    target: tuple[str, ...], at: datetime | None,
    lat: float | None, lon: float | None, alt: float | None, elements: Path | None,
) -> None:  # fmt: skip
    """Print where TARGET stands: look angle, range, rates, and what to expect there.

    TARGET is a satellite by name or number; sun, moon or a planet; 28.2E, 101W or a slot such as QO-100;
    ra=5h34m,dec=+22d; gal 120,-5; az 180 el 45. No dish and no network are needed.
    """
    from datetime import UTC, datetime

    from birdcage.cli.known_satellites import frozen_warning
    from birdcage.cli.options import wanted
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.where_report import Report, look_up
    from birdcage.sky.targets import UnknownTarget

    no_options_among(target)
    dish = wanted()
    observer = find_observer(dish.settings, lat, lon, alt)
    try:
        meant = look_up(" ".join(target), dish.paths, elements, say)
    except UnknownTarget as error:
        raise click.UsageError(textwrap.fill(str(error), TEXT_WIDTH)) from None
    report = Report.of(meant, observer, at or datetime.now(UTC), dish)
    warning = frozen_warning([] if report.elements is None else [report.elements])
    if warning is not None:
        say(warning)
    if flags().json:
        tell_json(report.values())
    else:
        for line in report.lines():
            tell(line)
