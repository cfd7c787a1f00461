"""`birdcage home`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import Wanted, flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.station.events import Event

HOLDER = "birdcage home"


@click.command("home", epilog=EPILOG)
@click.argument("axis", type=click.Choice(["az", "el"]), required=False)
@click.option("--yes", is_flag=True, help="Do not ask.")
@global_options()
def command(axis: str | None, yes: bool) -> None:
    """Home one axis or both: run into the end stops to find the reference.

    No command stops homing. Only cutting its power does. If another birdcage program has the port, that one homes it.
    """
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.owners import owners_of
    from birdcage.cli.say import position_lines, position_values, say, tell, tell_json
    from birdcage.cli.which import with_firmware
    from birdcage.station.events import ActivityChanged
    from birdcage.station.requests import Home
    from birdcage.station.state import Activity
    from birdcage.station.stop_words import stop_line

    dish_wanted = wanted()
    if not (dish_wanted.port_given and owners_of(dish_wanted)):  # else its program knows what answers there
        dish_wanted = with_firmware(dish_wanted)
        _refuse_if_by_itself(dish_wanted)
    _confirm(axis, yes)

    def hear(event: Event) -> None:
        if isinstance(event, ActivityChanged) and event.activity is Activity.HOMING:
            say(f"Homing the {event.text}. {stop_line(dish.state, dish.now)}")

    with reach_dish(dish_wanted, HOLDER, moves=True) as dish:
        model = dish.come_up(15.0).dish
        assert model is not None, "a station knows its dish from the start"
        axes = {None: (), "az": (model.azimuth.index,), "el": (model.elevation.index,)}[axis]
        dish.ask(Home(HOLDER, axes), 2 * (model.homing_s or 60.0) + 15.0, hear)
        state = dish.state
    position = state.position
    if position is None or state.position_lost is not None:
        if state.position_text:
            raise PositionUnknown(f"Homed. {state.position_text}", reason=state.position_lost)
        raise PositionUnknown("The position is still unknown. Home the other axis too.", reason=Reason.UNHOMED)
    if flags().json:
        tell_json({**position_values(position), "demo": state.demo})
    else:
        tell(position_lines(position))


def _refuse_if_by_itself(dish: Wanted) -> None:
    """Raise MotionRefused for a firmware that has no command for it: nothing is opened, nothing asked."""
    from birdcage.base.errors import MotionRefused

    model = dish.model
    if model is not None and model.never_homes:
        raise MotionRefused(model.no_homing, reason=Reason.UNSUPPORTED)
    if model is not None and model.homing_s is None:
        raise MotionRefused(
            f"The {model.name} homes only at power-up. Switch it off and on, and wait with "
            f"`birdcage init --firmware {model.firmware}`.",
            reason=Reason.UNSUPPORTED,
        )


def _confirm(axis: str | None, yes: bool) -> None:
    if yes:
        return
    what = {None: "both axes", "az": "the azimuth axis", "el": "the elevation axis"}[axis]
    consequence = (
        f"Homing turns {what} through the whole range, into the end stops. Only cutting the power stops it. "
        "Keep its swing clear."
    )
    if not sys.stdin.isatty():
        raise click.UsageError(f"{consequence} Give --yes to do it.")
    click.echo(consequence, err=True)
    if click.prompt("Type home to do it", default="", show_default=False, err=True).strip() != "home":
        raise click.Abort
