"""`birdcage sim`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import DEMO_FIRMWARE, flags, global_options


@click.command("sim", epilog=EPILOG)
@click.option("--speed", type=click.FloatRange(0.01, 1000.0), default=1.0, show_default=True,
              help="How many times faster than real time.")  # fmt: skip
@click.option("--seed", type=int, default=1, show_default=True, help="Seed of all random numbers.")
@click.option("--unhomed", is_flag=True, help="Start not homed, as after power-up with the TV search off.")
@click.option("--boot", is_flag=True, help="Start at power-on, with the boot log.")
@click.option("--pace-baud", type=click.IntRange(0), default=0, help="Send bytes at the pace of this baud rate.")
@click.option("--link", type=click.Path(path_type=Path), help="A symbolic link to the pty: a name that stays.")
@click.option("--tcp", is_flag=True, help="Serve on 127.0.0.1 instead of a pty.")
@click.option("--rig", type=click.IntRange(0, 65535), metavar="PORT",
              help="Serve a receiver beside it, too, as rigctld does; 0: at any free port.")  # fmt: skip
@click.option("--beacons", type=click.Path(path_type=Path), help="What that receiver hears: a JSON file.")
@click.option("-o", "options", metavar="KEY=VALUE", multiple=True, help="A setting of the simulated dish; repeatable.")
@global_options("firmware", "json", "verbose", firmware=DEMO_FIRMWARE)
@click.pass_context
def command(
    context: click.Context, speed: float, seed: int, unhomed: bool, boot: bool, pace_baud: int, link: Path | None,
    tcp: bool, rig: int | None, beacons: Path | None, options: tuple[str, ...],
) -> None:  # fmt: skip
    """Simulate a dish that any program can talk to: prints the port, and serves until Ctrl+C.

    With --json it prints one line: {"port": …, "firmware": …, "control": …}. Any --firmware that is not simulated
    is answered with the names of those that are.
    -o second_move=block makes a G2 refuse motor commands on the axis that runs, and -o second_other=block those on the
    other axis. -o move_reply=none makes it answer a move with nothing.
    --rig serves a receiver as Hamlib's rigctld does, heard through the dish's beam: `rigctl -m 2 -r 127.0.0.1:PORT l
    STRENGTH`.
    """
    from birdcage.sim.run import run_simulator

    given = flags()
    if given.get("port") or given.get("baud"):
        raise click.UsageError("--port and --baud name a dish; the simulator makes its own port.")
    pairs = dict(_pair(option) for option in options)
    try:
        status = run_simulator(
            given.get("firmware") or os.environ.get("BIRDCAGE_FIRMWARE") or DEMO_FIRMWARE,
            speed=speed, seed=seed, unhomed=unhomed, boot=boot, pace_baud=pace_baud, link=link, tcp=tcp,
            json=given.json, options=pairs, rig=rig, beacons=beacons,
        )  # fmt: skip
    except (ValueError, OSError) as error:
        raise click.UsageError(_sentence(str(error))) from error
    context.exit(status)


def _sentence(text: str) -> str:
    return text if text.endswith("?") else f"{text}."


def _pair(option: str) -> tuple[str, str]:
    name, equals, value = option.partition("=")
    if not equals:
        raise click.BadParameter(f"{option!r} is not KEY=VALUE.", param_hint="-o")
    return name, value
