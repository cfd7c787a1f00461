"""`birdcage drift`."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.station.task_state import TaskValue

HOLDER = "birdcage drift"
SLEW_S = 30.0
"""From now to the first reading: the dish has to get there."""


@click.command("drift", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1, required=True)
@click.option("--minutes", type=click.FloatRange(0.1, 360.0),
              help="How long to listen.  [default: until 3 widths of the beam have passed]")  # fmt: skip
@click.option("--width", "width_deg", metavar="DEG", type=click.FloatRange(0.1, 60.0),
              help="Expected width of the beam at half height.  [default: the feed's]")  # fmt: skip
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, target: tuple[str, ...], minutes: float | None, width_deg: float | None, source: str | None
) -> None:
    """Park ahead of TARGET, let it drift through the beam, and measure the beam. Ctrl+C stops the dish.

    TARGET is the Sun, the Moon, a star or a satellite that moves. The dish rests all the time, so no motor error
    counts. Each reading is a line: degrees past the dish, mean, and scatter. A beam is fitted to them. Its width is
    told, and how far it looks ahead of the dish's direction, or behind it. Without a source the exit status is 1.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.line_heard import LineHeard
    from birdcage.cli.say import say
    from birdcage.cli.signal_task import follow_task, ready_dish
    from birdcage.cli.source_where import named, path_from
    from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
    from birdcage.signal.drift_task import MOST_S, SLOWEST_DEG_S, WIDTHS, DriftTask

    no_options_among(target)
    wants = wanted()
    by = heard_by(source, wants.settings)
    meant = named(target, wants)
    begin_s = time.time()
    rate_deg_s = path_from(meant, wants, begin_s, 60.0).moves_deg_s(begin_s + 30.0)
    if rate_deg_s < SLOWEST_DEG_S:
        raise click.UsageError(f"{meant.name} stands still on the sky: it can't drift through the beam. Use `sweep`.")
    with reach_dish(wants, HOLDER, moves=True) as dish:
        _position, known_deg = ready_dish(dish, by, named=True)
        width_deg = width_deg or known_deg
        passes_s = WIDTHS * (width_deg or ASSUMED_WIDTH_DEG) / rate_deg_s
        length_s = min(minutes * 60.0 if minutes else passes_s, MOST_S)
        path = path_from(meant, wants, time.time() + SLEW_S, length_s)
        say(f"{meant.name} passes at {_clock(path.begin_s + length_s / 2)} UTC. Over at {_clock(path.end_s)} UTC.")
        values: dict[str, TaskValue] = {"path": tuple(path.rows), "width_deg": width_deg, "source": by}
        takes_s = SLEW_S + length_s + 300.0
        lines = LineHeard(_written, as_json=flags().json)
        with lines.kept(dish):
            ended = follow_task(dish, DriftTask.kind, values, HOLDER, takes_s, "{} of {} readings …", lines.show)
        demo = dish.state.demo
    if not lines.tell_end(ended, demo=demo):
        context.exit(exits.NOT_DONE)


def _clock(time_s: float) -> str:
    from datetime import UTC, datetime

    return f"{datetime.fromtimestamp(time_s, UTC):%H:%M:%S}"


def _written(row: Sequence[float]) -> str:
    ahead_deg, _zero, mean, scatter, _count = row
    return f"{ahead_deg:+7.2f} {mean:8.1f} ±{scatter:.1f}"
