"""`birdcage setup`."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import Wanted, flags, global_options, wanted
from birdcage.setup.step import NAMES

if TYPE_CHECKING:
    from birdcage.setup.engine import Setup
    from birdcage.station.session import Session

HOLDER = "birdcage setup"


@click.command("setup", epilog=EPILOG)
@click.option("--list", "listing", is_flag=True, help="Print the steps and their state. The port stays closed.")
@click.option("--step", type=click.Choice(NAMES), help="Begin with this step.")
@global_options()
def command(listing: bool, step: str | None) -> None:
    """Go from wires to the first satellite, step by step, and keep what is found in birdcage.toml.

    Leave at any time and go on later: it begins with the first open step. Nothing moves until you confirm that the
    area is clear. Ctrl+C stops the dish. --list and --json print how far it is.
    """
    from birdcage.base.config import load
    from birdcage.base.machine_port import port_of
    from birdcage.cli.dish import open_dish
    from birdcage.cli.say import say
    from birdcage.cli.talk import Conversation, TypedLines

    dish_wanted = wanted()
    dish_wanted = _with_firmware(dish_wanted, detect=not listing and not flags().json)
    if listing or flags().json:
        _print(dish_wanted)
        return
    if not sys.stdin.isatty():
        raise click.UsageError("The setup needs a terminal to ask its questions. --list needs none.")
    answers = TypedLines(sys.stdin)
    while True:
        with open_dish(dish_wanted, moves=True) as dish:
            setup = _setup(dish.session, dish_wanted)
            if step is not None:
                setup.go(step)
            try:
                finished = Conversation(setup, dish, answers).run()
            finally:
                setup.close()
            firmware = setup.begin_anew
        if not firmware:
            break
        # Another dish than was thought: its firmware has been saved, and counts over what was given at the start.
        for name in ("firmware", "baud"):
            flags().values.pop(name, None)
        given, kept = flags().get("port"), load(dish_wanted.paths.config_file, environ={}).dish.port
        if port_of(firmware, given, kept) != given:
            flags().values.pop("port", None)
        dish_wanted = replace(wanted(), firmware=firmware, firmware_given=True)
        say(f"Beginning again, speaking {firmware}.")
    say("The setup is complete." if finished else "Setup is not finished. `birdcage setup` continues it.")


def _with_firmware(dish: Wanted, *, detect: bool) -> Wanted:
    """Listen which firmware answers, when none was named: a new user can't know its name."""
    if dish.firmware_given or not detect:
        return dish
    from birdcage.base.clock import RealClock
    from birdcage.cli.say import say
    from birdcage.cli.which import ask_port, take

    found = ask_port(dish, RealClock(), tell=say)
    say(found.sentence)
    # Without any, the setup finds out with a person's help: it begins with the default.
    return replace(dish, firmware_given=True) if found.firmware is None else take(dish, found, found.firmware)


def _setup(session: Session, dish: Wanted) -> Setup:
    from birdcage.setup.engine import Setup

    given = flags()
    over = {f"dish.{name}": given.get(name) for name in ("port", "firmware", "baud")}
    return Setup(session, dish.settings, dish.paths, flags=over, holder=HOLDER)


def _print(dish: Wanted) -> None:
    """Print the steps as the file has them; what only the dish knows is not known here."""
    from birdcage.base.clock import RealClock
    from birdcage.cli.say import tell, tell_json
    from birdcage.cli.talk import list_lines
    from birdcage.station.build import open_session

    session = open_session(
        port=dish.port, firmware=dish.firmware, baud=dish.baud, settings=dish.settings, paths=dish.paths,
        clock=RealClock(),
    )  # fmt: skip
    try:
        setup = _setup(session, dish)
        if flags().json:
            tell_json([
                {"number": each.number, "name": each.name, "title": each.title, "state": each.mark.value,
                 "evidence": each.evidence or None}
                for each in setup.steps()
            ])  # fmt: skip
            return
        for line in list_lines(setup):
            tell(line)
    finally:
        session.close()
