"""`birdcage on-off`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from birdcage.station.task_state import TaskValue

HOLDER = "birdcage on-off"
TAKES_S = 3600.0
"""How long a comparison may take, and how far ahead the way of a target is computed."""


@click.command("on-off", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--away", "away_deg", metavar="DEG", type=click.FloatRange(0.1, 90.0),
              help="How far beside it to listen.  [default: 3 widths of the beam]")  # fmt: skip
@click.option("--axis", type=click.Choice(["az", "el"]), default=None,
              help="Along which axis the sides lie.  [default: az; el for a satellite of the arc]")  # fmt: skip
@click.option("--cycles", type=click.IntRange(2, 200), default=3, show_default=True,
              help="How often: on it, beside it twice, on it.")  # fmt: skip
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, target: tuple[str, ...], away_deg: float | None, axis: str | None, cycles: int,
    source: str | None,
) -> None:  # fmt: skip
    """Compare the signal of TARGET with the sky on either side of it. Ctrl+C stops the dish.

    Without a TARGET the source is where the dish points now. The dish points at it, beside it on one side, on the
    other, and at it again. The difference is told with its standard error, by the scatter of the cycles. A side beyond
    the limits is left out; where both are, the exit status is 1.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.signal_task import follow_task, ready_dish
    from birdcage.cli.source_where import path_now
    from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
    from birdcage.signal.on_off_task import BEAMS_AWAY, OnOffTask
    from birdcage.sky.targets.model import SlotTarget

    no_options_among(target)
    wants = wanted()
    by = heard_by(source, wants.settings)
    meant, path_at = path_now(target, wants, TAKES_S)
    with reach_dish(wants, HOLDER, moves=True) as dish:
        position, width_deg = ready_dish(dish, by, named=meant is not None)
        values: dict[str, TaskValue] = {
            "path": tuple(path_at(position).rows), "cycles": cycles, "source": by,
            "away_deg": away_deg or BEAMS_AWAY * (width_deg or ASSUMED_WIDTH_DEG),
            "axis": axis or ("el" if isinstance(meant, SlotTarget) else "az"),
        }  # fmt: skip
        ended = follow_task(dish, OnOffTask.kind, values, HOLDER, TAKES_S, "{} of {} directions heard …")
        demo = dish.state.demo
    if not ended.found:
        say(ended.why)
        context.exit(exits.NOT_DONE)
    if flags().json:
        tell_json({**ended.found, "demo": demo})
    else:
        tell(ended.why)
