"""`birdcage sync`."""

from __future__ import annotations

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

HOLDER = "birdcage sync"


@click.command("sync", epilog=EPILOG, context_settings={"ignore_unknown_options": True})
@click.argument("az", type=float)
@click.argument("el", type=float, required=False)
@click.option("--yes", is_flag=True, help="Do not ask, where the machine believes otherwise.")
@global_options()
def command(az: float, el: float | None, yes: bool) -> None:
    """Sync a rotator: say where it points now, AZ and EL in true degrees. Nothing moves.

    For a machine whose zero is where it was switched on: a rotator without a home switch. Look along it, then
    sync it. EL may be left out where it measures its elevation itself. A sync holds until the machine loses its power,
    or another program moves it. If another birdcage program has the port, that one syncs it.
    """
    from birdcage.base.errors import ConfirmationNeeded
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.commands.get import confirm
    from birdcage.cli.say import position_lines, position_values, tell, tell_json
    from birdcage.station.requests import Sync
    from birdcage.station.state import Pointing

    with reach_dish(wanted(), HOLDER) as dish:
        dish.come_up(15.0)
        request = Sync(az, el, HOLDER, agreed=yes)
        try:
            found = dish.ask(request, WITHIN_S)
        except ConfirmationNeeded as question:
            words, _, asked = str(question).rpartition(". ")
            confirm(f"{words}.", yes, asked)
            found = dish.ask(Sync(az, el, HOLDER, agreed=True), WITHIN_S)
        state = dish.state
    assert isinstance(found, Pointing), "a sync ends with where it then points"
    if flags().json:
        tell_json({**position_values(found), "port": state.port, "demo": state.demo})
    else:
        tell(position_lines(found))


WITHIN_S = 15.0
"""How long a sync may take."""
