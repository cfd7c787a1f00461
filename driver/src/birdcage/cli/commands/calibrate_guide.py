"""`birdcage calibrate guide`."""

from __future__ import annotations

import sys

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

HOLDER = "birdcage calibrate"


@click.command("guide", short_help="Guide you through all of it, at the dish.", epilog=EPILOG)
@global_options()
def guide() -> None:
    """Be led: it names the next object and goes there; you nudge until the meter is highest, and say so.

    Every peak is saved at once. Ctrl+C stops the dish.
    """
    from birdcage.calibration.guide import Guide
    from birdcage.calibration.work import observer_of
    from birdcage.cli.calibrate_talk import CalibrateTalk
    from birdcage.cli.dish import open_dish
    from birdcage.cli.talk import TypedLines

    if not sys.stdin.isatty():
        raise click.UsageError("The guide needs a terminal to ask its questions.")
    dish_wanted = wanted()
    observer_of(dish_wanted.settings)  # without a place there is nothing to begin with
    given = flags()
    over = {f"dish.{name}": given.get(name) for name in ("port", "firmware", "baud")}
    with open_dish(dish_wanted, moves=True) as dish:
        dish.come_up(15.0)
        dish.survey()
        leading = Guide(dish.session, dish_wanted.settings, dish_wanted.paths, flags=over, holder=HOLDER)
        try:
            CalibrateTalk(leading, dish, TypedLines(sys.stdin), dish_wanted.paths).run()
        finally:
            leading.close()
