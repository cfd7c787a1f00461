"""`birdcage move`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.cli.dish import Dish
    from birdcage.station.events import Event
    from birdcage.station.requests import Goto

HOLDER = "birdcage move"


@click.command("move", epilog=EPILOG)
@click.option("--az", "az_deg", type=float, required=True, help="Azimuth in degrees, clockwise from true north.")
@click.option("--el", "el_deg", type=float, required=True, help="Elevation in degrees.")
@click.option("--leapfrog/--no-leapfrog", help="Aim beyond the target, as older scripts did.  [default: exact]")
@click.option("--clamp", is_flag=True, help="Go to the nearest allowed elevation instead of refusing.")
@click.option("--no-wait", is_flag=True, help="End once the dish has taken the target; nobody watches it then.")
@click.option("--timeout", "timeout_s", type=click.FloatRange(1.0, 3600.0), default=120.0, show_default=True,
              help="Seconds until it counts as failed, and is stopped.")  # fmt: skip
@global_options()
def command(
    az_deg: float, el_deg: float, leapfrog: bool, clamp: bool, no_wait: bool, timeout_s: float
) -> None:  # fmt: skip
    """Point the dish, and wait until it is there. Ctrl+C stops it."""
    from birdcage.cli.dish import open_dish
    from birdcage.cli.say import position_lines, position_values, tell, tell_json
    from birdcage.station.requests import Goto
    from birdcage.station.state import Pointing

    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise click.UsageError("--az and --el must be numbers.")
    with open_dish(wanted(), moves=True) as dish:
        dish.come_up(15.0)
        if leapfrog:
            az_deg, el_deg = _beyond(dish, az_deg, el_deg)
        request = Goto(az_deg, el_deg, HOLDER, clamp=clamp)
        if no_wait:
            _begin(dish, request, timeout_s)
            return
        arrived = dish.ask(request, timeout_s, Shown(dish))
    assert isinstance(arrived, Pointing), "a go-to resolves with the position at arrival"
    if flags().json:
        tell_json({**position_values(arrived), "demo": dish.state.demo})
    else:
        tell(position_lines(arrived))


def _beyond(dish: Dish, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Apply the fixed overshoot of document 003 against the position that was just read."""
    from birdcage.base.errors import PositionUnknown
    from birdcage.cli.dish import how_to_home
    from birdcage.cli.say import say
    from birdcage.leapfrog import apply_leapfrog

    position = dish.state.position
    if position is None or dish.state.position_lost is not None:
        raise PositionUnknown(f"--leapfrog needs to know where the dish is. {how_to_home(dish.state)}")
    beyond = apply_leapfrog(az_deg, el_deg, position.az_deg, position.el_deg)
    if beyond != (az_deg, el_deg):
        say(f"Leap-frog: aiming at AZ {beyond[0]:.2f}° EL {beyond[1]:.2f}°.")
    return beyond


def _begin(dish: Dish, request: Goto, timeout_s: float) -> None:
    """Wait until the dish has taken the target, and leave it moving."""
    from birdcage.cli.say import say
    from birdcage.station.events import MoveStarted

    started: list[Event] = []

    def hear(event: Event) -> None:
        if isinstance(event, MoveStarted):
            started.append(event)

    future, deadline = dish.station.submit(request), dish.now + timeout_s
    while not future.done() and not started and dish.now < deadline:
        dish.look(hear)
    if future.done():
        future.result()
    dish.leave_moving = True
    say(f"On its way to AZ {request.az_deg:.2f}° EL {request.el_deg:.2f}°. `birdcage stop` stops it.")


class Shown:
    """Shows how far it is on a terminal."""

    def __init__(self, dish: Dish) -> None:
        self._progress = dish.progress

    def __call__(self, event: Event) -> None:
        """Hear an event."""
        from birdcage.station.events import ActivityChanged, MoveProgress

        if isinstance(event, ActivityChanged) and event.text:
            self._progress.show(f"The dish is {event.text} …")
        if isinstance(event, MoveProgress):
            at = event.position
            mark = "~" if at.modelled else " "
            self._progress.show(
                f"AZ{mark}{at.az_deg:6.2f}° EL{mark}{at.el_deg:5.2f}°  "
                f"{event.to_go_deg:.2f}° to go, {event.left_s:.1f} s{', modelled' if at.modelled else ''}"
            )
