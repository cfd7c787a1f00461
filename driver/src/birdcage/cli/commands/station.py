"""`birdcage station`."""

from __future__ import annotations

from contextlib import ExitStack

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.group("station", epilog=exits.EPILOG)
def command() -> None:
    """Drive the dish without a face, for programs that attach to it."""


@command.command("run", epilog=exits.EPILOG)
@click.option("--skip-init", is_flag=True, help="Do not read the dish's identity and settings at the start.")
@click.option("--print-systemd", is_flag=True, help="Print a unit for systemd that runs this, and do nothing else.")
@click.option("--also", metavar="FILE", help="Drive a second dish, too: FILE is a birdcage.toml of its own.")
@global_options()
def run(skip_init: bool, print_systemd: bool, also: str | None) -> None:
    """Drive the dish until Ctrl+C or another signal ends it, STOP first.

    `birdcage pos`, `move`, `home`, `stop`, `status`, `get`, `set` and `events` then go through it, and none of them
    needs the port. It goes on while the cable is out, or the dish is off. With --json, stdout has what happens in the
    form of docs/events.md. With --also it drives two dishes, each by its own settings. What ends it stops both.
    """
    from birdcage.cli.also import also_wanted
    from birdcage.cli.dish import open_dishes
    from birdcage.cli.say import say, tell
    from birdcage.cli.station_desk import serve_desk
    from birdcage.cli.station_run import run_station
    from birdcage.cli.systemd_unit import station_unit

    wants = wanted()
    second = None if also is None else also_wanted(wants, also)
    if print_systemd:
        tell(station_unit(wants, skip_init=skip_init, also=also))
        return
    all_wanted = [wants] if second is None else [wants, second]
    with open_dishes(all_wanted, moves=True, survey=not skip_init) as dishes, ExitStack() as desks:
        for dish, each in zip(dishes, all_wanted, strict=True):
            desks.enter_context(serve_desk(dish, each))
        if second is None:
            say(f"Driving the dish at {wants.port}. Other birdcage programs reach it through this one. Ctrl+C ends it.")
        else:
            say(f"Driving the dishes at {wants.port} and {second.port}. Other birdcage programs reach them through "
                "this one. Ctrl+C ends it.")  # fmt: skip
        run_station(dishes, as_json=bool(flags().json))
