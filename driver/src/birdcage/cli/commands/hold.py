"""`birdcage hold`."""

from __future__ import annotations

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.command("hold", epilog=exits.EPILOG)
@global_options()
@click.pass_context
def command(context: click.Context) -> None:
    """Stop the dish, and keep every birdcage program from moving it until a person releases it.

    If another birdcage program has the port, that one stops the dish. If none has, nothing is sent: `birdcage stop`
    stops a dish that moves by itself. It stays HELD for every birdcage program, also after a restart of this machine.
    Other programs ignore it: to work on the dish, cut its power.
    """
    from birdcage.base.clock import RealClock
    from birdcage.base.errors import CommandRefused, NoReply
    from birdcage.base.held import user_name
    from birdcage.cli.owners import ring_owners
    from birdcage.cli.say import tell, tell_json
    from birdcage.station.control_messages import HoldDish
    from birdcage.station.holding import hold

    dish, by, now = wanted(), f"{user_name()} (birdcage hold)", RealClock().utc()
    try:
        told = ring_owners(dish, HoldDish(by), by)
    except (NoReply, CommandRefused) as error:
        hold(dish.paths, dish.port, by, now)
        error.add_note("Every birdcage program that starts now finds it HELD.")
        raise
    if not told:
        note = hold(dish.paths, dish.port, by, now)
        told = [{"port": dish.port, "confirmed": None, "sentence": f"{note.sentence} Nothing was sent to {dish.port}."}]
    for each in told:
        if flags().json:
            tell_json(each | {"held": True})
        else:
            tell(f"{each['sentence']} `birdcage release` lets it move again.")
    if any(each["confirmed"] is False for each in told):
        context.exit(exits.NOT_DONE)
