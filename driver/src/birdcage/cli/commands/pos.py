"""`birdcage pos`."""

from __future__ import annotations

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

HOLDER = "birdcage pos"


@click.command("pos", epilog=EPILOG)
@global_options()
def command() -> None:
    """Print where the dish points, in true degrees: one question to the dish.

    That is the direction of its beam: a target that it follows stands there with refraction included. If another
    birdcage program has the port, that one is asked.
    """
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.dish import why_unknown
    from birdcage.cli.say import position_lines, position_values, tell, tell_json

    with reach_dish(wanted(), HOLDER, survey=False) as dish:
        dish.come_up(15.0)
        dish.look_anew()
        state = dish.state
    position = state.position
    if position is None or state.position_lost is not None:
        raise PositionUnknown(why_unknown(state), reason=state.position_lost)
    if flags().json:
        tell_json({**position_values(position), "port": state.port, "demo": state.demo})
    else:
        tell(position_lines(position))
