"""`birdcage motors`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from birdcage.cli.commands.motors_run import run
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.rotator.facts import Facts
    from birdcage.station.task_state import TaskState

HOLDER = "birdcage motors"
AXES = ("azimuth", "elevation")
TAKES_S = 300.0
"""For all ways of both axes: a quick dish takes half a minute."""


@click.group("motors", epilog=EPILOG, invoke_without_command=True)
@click.option("--axis", type=click.Choice(AXES), help="Test this axis only.  [default: both, one after the other]")
@click.option("--yes", is_flag=True, help="Do not ask.")
@click.pass_context
@global_options()
def command(context: click.Context, axis: str | None, yes: bool) -> None:
    """Test the motors: measure speed and acceleration, and watch for stalls. Ctrl+C stops the dish.

    Each axis turns up to 60 degrees to and fro, three times, at full speed, and then back to where it stood. Limits,
    cable and no-go sectors may make that shorter. The position is read all the way. What was measured is printed beside
    what is expected, and kept. A motor that stalls ends the test, and the exit status is 1.

    With `run`, a motor runs for some seconds instead, without a target.
    """
    if context.invoked_subcommand is None:
        _test(axis, yes)
    elif axis or yes:
        raise click.UsageError(f"Give no --axis with {context.invoked_subcommand}, and --yes behind it.")


command.add_command(run)


def _test(axis: str | None, yes: bool) -> None:
    from birdcage.base.errors import BirdcageError
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.dish import need_position
    from birdcage.cli.motors_report import tell_motors, values_of_motors
    from birdcage.cli.owners import owners_of
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.signal_task import follow_task
    from birdcage.cli.which import with_firmware
    from birdcage.diagnostics.motor_test_task import KIND

    wants = wanted()
    if not (wants.port_given and owners_of(wants)):  # else its program knows what answers there
        wants = with_firmware(wants)
        _refuse(wants.model)
    _confirm(axis, yes)
    with reach_dish(wants, HOLDER, moves=True) as dish:
        _refuse(dish.come_up(15.0).dish)
        need_position(dish, "Nothing was measured.")

        def doing(task: TaskState) -> str:
            return f"way {(task.done or 0) + 1} of {task.of} …"

        try:
            ended = follow_task(dish, KIND, {"axis": axis or ""}, HOLDER, TAKES_S, doing)
        except BirdcageError:
            if (fault := dish.state.fault) is not None:
                say(f"{fault.meaning} {fault.remedy}")
            raise
        demo = dish.state.demo
    if flags().json:
        tell_json({**values_of_motors(ended.found), "complete": True, "demo": demo})
    else:
        tell_motors(ended.found)
        say(ended.why)


def _refuse(dish: Facts | None) -> None:
    """Raise MotionRefused for a machine whose motors can't be measured."""
    from birdcage.base.errors import MotionRefused
    from birdcage.base.reason import Reason
    from birdcage.diagnostics.motor_test_words import not_measured

    if dish is not None and (why := not_measured(dish)):
        raise MotionRefused(why, reason=Reason.UNSUPPORTED)


def _confirm(axis: str | None, yes: bool) -> None:
    if yes:
        return
    what = "the azimuth and then the elevation" if axis is None else f"the {axis}"
    consequence = (
        f"The motor test turns {what} up to 60° to and fro, three times, at full speed, and then back. "
        "Where the azimuth has no room, it first turns to a place that has. Keep the whole swing of the dish clear."
    )
    if not sys.stdin.isatty():
        raise click.UsageError(f"{consequence} Give --yes to do it.")
    click.echo(consequence, err=True)
    click.confirm("Start the motor test?", abort=True, err=True)
