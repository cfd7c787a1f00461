"""`birdcage sweep`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.station.task_state import TaskValue

HOLDER = "birdcage sweep"
TAKES_S = 3600.0
"""How long a sweep may take."""


@click.command("sweep", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("axis", type=click.Choice(["az", "el"]), metavar="AXIS")
@click.argument("target", nargs=-1)
@click.option("--span", "span_deg", metavar="DEG", type=click.FloatRange(0.1, 360.0), default=20.0, show_default=True,
              help="From one end to the other.")  # fmt: skip
@click.option("--step", "step_deg", metavar="DEG", type=click.FloatRange(0.05, 90.0), default=1.0, show_default=True,
              help="From one direction to the next.")  # fmt: skip
@click.option("--go", is_flag=True, help="End in the middle of the source that is found; else where it began.")
@click.option("--by", "how", type=click.Choice(["steps", "firmware"]), default="steps", show_default=True,
              help="Who sweeps: birdcage step by step, or the dish by itself.")  # fmt: skip
@click.option("--transponders", metavar="N", type=click.IntRange(1, 32), default=None,
              help="How many the firmware goes through in each direction; one without this.")  # fmt: skip
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, axis: str, target: tuple[str, ...], span_deg: float, step_deg: float, go: bool,
    how: str, transponders: int | None, source: str | None,
) -> None:  # fmt: skip
    """Sweep AXIS, az or el, through TARGET or through where the dish points now. Ctrl+C stops it.

    In each direction the dish comes to rest and reads the signal; a line is printed: azimuth, elevation, mean, and
    scatter of one reading. Then a beam on a floor is fitted, together with satellites of the arc that stand near by.
    Directions beyond the limits are left out. Without a source the exit status is 1.

    --by firmware: a dish that can do so sweeps and listens by itself, which is quicker. Ctrl+C sends it a key then, and
    it may go on to its end all the same. Which way it turns is not known: the span must be free on both sides of where
    it begins, else the sweep is refused.
    """
    from birdcage.base.config.signals import OWN_TUNER
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.commands.move import direction_to
    from birdcage.cli.line_heard import LineHeard
    from birdcage.cli.signal_task import follow_task, known_slots, ready_dish
    from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
    from birdcage.signal.firmware_sweep_task import FirmwareSweepTask
    from birdcage.signal.slots_heard import patterns_near
    from birdcage.signal.sweep_task import SweepTask

    no_options_among(target)
    wants = wanted()
    by_itself = how == "firmware"
    if not by_itself and transponders is not None:
        raise click.UsageError("--transponders needs --by firmware.")
    if by_itself and source not in (None, OWN_TUNER):
        raise click.UsageError(f"--by firmware hears by the dish's own tuner, not by {source}. Leave --source out.")
    by = OWN_TUNER if by_itself else heard_by(source, wants.settings)
    there = direction_to(target, None, None, wants, None) if target else None
    with reach_dish(wants, HOLDER, moves=True) as dish:
        position, width_deg = ready_dish(dish, None if by_itself else by, named=bool(target))
        if there is None:
            assert position is not None, "it was waited for"
            there = position.az_deg, position.el_deg
        az_deg, el_deg = there
        values: dict[str, TaskValue] = {
            "axis": axis, "az_deg": az_deg, "el_deg": el_deg, "span_deg": span_deg, "step_deg": step_deg,
            "width_deg": width_deg, "go": go, "source": by,
            "patterns": patterns_near(az_deg, el_deg, known_slots(wants), width_deg or ASSUMED_WIDTH_DEG),
        }  # fmt: skip
        if by_itself:
            values["transponders"] = transponders or 1
        kind = FirmwareSweepTask.kind if by_itself else SweepTask.kind
        lines = LineHeard(_written, as_json=flags().json)
        with lines.kept(dish):
            ended = follow_task(dish, kind, values, HOLDER, TAKES_S, "{} of {} directions heard …", lines.show)
        demo = dish.state.demo
    if not lines.tell_end(ended, demo=demo):
        context.exit(exits.NOT_DONE)


def _written(row: Sequence[float]) -> str:
    az_deg, el_deg, mean, scatter, _count = row
    return f"{az_deg:7.2f} {el_deg:6.2f} {mean:8.1f} ±{scatter:.1f}"
