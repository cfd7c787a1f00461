"""`birdcage peak`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among

if TYPE_CHECKING:
    from birdcage.cli.station_command import StationCommand
    from birdcage.station.events import Event
    from birdcage.station.task_state import TaskState

HOLDER = "birdcage peak"
TAKES_S = 600.0
"""How long a peak may take: a slow dish needs some seconds for each of its directions."""


@click.command("peak", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--width", "width_deg", metavar="DEG", type=click.FloatRange(0.1, 60.0),
              help="Expected width of the beam at half height.  [default: the feed's]")  # fmt: skip
@global_options()
@click.pass_context
def command(context: click.Context, target: tuple[str, ...], width_deg: float | None) -> None:
    """Find the middle of a source by its signal, and point there. Ctrl+C stops it.

    The dish goes through 25 directions around TARGET, or around where it points now, and reads its own tuner in each. A
    beam is fitted to all of them; the dish ends in its middle. Without a source it goes back to the middle of the grid,
    and the exit status is 1. The ± counts noise alone: a neighbour in the arc pulls the middle by some tenths of a
    degree.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.commands.move import direction_to
    from birdcage.cli.dish import need_position
    from birdcage.cli.say import say, tell, tell_json

    no_options_among(target)
    wants = wanted()
    there = direction_to(target, None, None, wants, None) if target else None
    with reach_dish(wants, HOLDER, moves=True) as dish:
        dish.come_up(15.0)
        need_position(dish)
        position, beam = dish.state.position, dish.state.beam
        assert position is not None, "it was waited for"
        az_deg, el_deg = there or (position.az_deg, position.el_deg)
        width_deg = width_deg or (0.0 if beam is None else beam.mean_deg)
        ended = _find(dish, az_deg, el_deg, width_deg)
        demo = dish.state.demo
    if not ended.found:
        say(ended.why)
        context.exit(exits.NOT_DONE)
    if flags().json:
        tell_json({**ended.found, "demo": demo})
    else:
        tell(ended.why)


def _find(dish: StationCommand, az_deg: float, el_deg: float, width_deg: float) -> TaskState:
    """Have the station do it, show how far it is, and return how it ended. BirdcageError where it can't be begun."""
    from birdcage.base.errors import BirdcageError, CommandRefused
    from birdcage.base.reason import Reason
    from birdcage.signal.peak_task import PeakTask
    from birdcage.station.events import TaskChanged
    from birdcage.station.requests import BeginTask
    from birdcage.station.task_state import TaskPhase

    facts = dish.state.dish
    if facts is not None and not facts.has_rssi:
        raise CommandRefused(f"The {facts.name} has no tuner to read. Nothing was sent.", reason=Reason.UNSUPPORTED)
    ended: dict[int, TaskState] = {}
    """By number: another program may have a peak of its own, and this one may be over before its number is known."""

    def hear(event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == PeakTask.kind:
            dish.progress.show(f"{event.task.done or 0} of {event.task.of} directions heard …")
            if event.task.phase is TaskPhase.OVER:
                ended[event.task.number] = event.task

    values = {"az_deg": az_deg, "el_deg": el_deg, "width_deg": width_deg}
    number = dish.ask(BeginTask(PeakTask.kind, values, HOLDER), 30.0, hear)
    assert isinstance(number, int), "a task that has begun has one"
    deadline = dish.now + TAKES_S
    while number not in ended:
        if dish.now > deadline:
            raise BirdcageError(f"No peak within {TAKES_S:.0f} s.", reason=Reason.TIMEOUT)
        dish.look(hear)
    dish.progress.clear()
    if not ended[number].is_done:
        raise BirdcageError(ended[number].why)
    return ended[number]
