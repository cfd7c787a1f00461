"""`birdcage station`."""

from __future__ import annotations

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.group("station", epilog=exits.EPILOG)
def command() -> None:
    """Drive the dish without a face, for programs that attach to it."""


@command.command("run", epilog=exits.EPILOG)
@click.option("--skip-init", is_flag=True, help="Do not read the dish's identity and settings at the start.")
@click.option("--print-systemd", is_flag=True, help="Print a unit for systemd that runs this, and do nothing else.")
@global_options()
def run(skip_init: bool, print_systemd: bool) -> None:
    """Drive the dish until Ctrl+C or another signal ends it, STOP first.

    `birdcage pos`, `move`, `home`, `stop`, `status`, `get`, `set` and `events` then go through it, and none of them
    needs the port. It goes on while the cable is out, or the dish is off. With --json, stdout has what happens in the
    form of docs/events.md.
    """
    from birdcage.cli.dish import open_dish
    from birdcage.cli.say import say, tell
    from birdcage.cli.station_desk import serve_desk
    from birdcage.cli.station_run import run_station
    from birdcage.cli.systemd_unit import station_unit

    wants = wanted()
    if print_systemd:
        tell(station_unit(wants, skip_init=skip_init))
        return
    with open_dish(wants, moves=True, survey=not skip_init) as dish, serve_desk(dish, wants):
        say(f"Driving the dish at {wants.port}. Other birdcage programs reach it through this one. Ctrl+C ends it.")
        run_station(dish, as_json=bool(flags().json))
