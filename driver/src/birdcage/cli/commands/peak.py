"""`birdcage peak`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from collections.abc import Mapping

    from birdcage.cli.options import Wanted
    from birdcage.station.state import Pointing
    from birdcage.station.task_state import TaskValue

HOLDER = "birdcage peak"
TAKES_S = 600.0
"""How long a peak may take: a slow dish needs some seconds for each of its directions."""


@click.command("peak", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--width", "width_deg", metavar="DEG", type=click.FloatRange(0.1, 60.0),
              help="Expected width of the beam at half height.  [default: the feed's]")  # fmt: skip
@click.option("--calibrate", is_flag=True, help="Keep the peak of TARGET for `birdcage calibrate fit`.")
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, target: tuple[str, ...], width_deg: float | None, calibrate: bool, source: str | None
) -> None:
    """Find the peak of a source by its signal, and point there. Ctrl+C stops it.

    The dish goes through 25 directions around TARGET, or around where it points now, and reads the signal in each. A
    beam is fitted to all of them; the dish ends in its middle. Satellites of the arc that stand near by are fitted
    together with it, which needs a place and a north that is set. Without a source the dish goes back to the middle of
    the grid, and the exit status is 1. The ± counts noise alone.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.commands.move import direction_to
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.signal_task import follow_task, known_slots, ready_dish
    from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
    from birdcage.signal.peak_task import PeakTask
    from birdcage.signal.slots_heard import patterns_near

    no_options_among(target)
    if calibrate and not target:
        raise click.UsageError("--calibrate needs a TARGET: where it stands is what is compared.")
    wants = wanted()
    by = heard_by(source, wants.settings)
    there = direction_to(target, None, None, wants, None) if target else None
    with reach_dish(wants, HOLDER, moves=True) as dish:
        position, known_deg = ready_dish(dish, by, named=bool(target))
        if there is None:
            assert position is not None, "it was waited for"
            there = position.az_deg, position.el_deg
        az_deg, el_deg = there
        width_deg = width_deg or known_deg
        beam = width_deg or ASSUMED_WIDTH_DEG
        patterns = patterns_near(az_deg, el_deg, known_slots(wants), beam)
        values: dict[str, TaskValue] = {
            "az_deg": az_deg,
            "el_deg": el_deg,
            "width_deg": width_deg,
            "patterns": patterns,
            "source": by,
        }
        ended = follow_task(dish, PeakTask.kind, values, HOLDER, TAKES_S, "{} of {} directions heard …")
        dish.look_anew()
        demo, position = dish.state.demo, dish.state.position or position
    if not ended.found:
        say(ended.why)
        context.exit(exits.NOT_DONE)
    if flags().json:
        tell_json({**ended.found, "demo": demo})
    else:
        tell(ended.why)
    if calibrate:
        assert position is not None, "it has just come to rest"
        say(_keep(target, wants, ended.found, position))


def _keep(target: tuple[str, ...], wants: Wanted, found: Mapping[str, TaskValue], position: Pointing) -> str:
    """Keep it as a peak of the calibration, and say so. StoreError where that can't be done."""
    from birdcage.calibration.peak_search import peak_found
    from birdcage.calibration.peaks_file import add_peak, peaks_file
    from birdcage.cli.named_target import find_target

    meant = find_target(target, wants.paths, None, lambda _words: None).target
    peak = peak_found(wants.settings, meant, position, found)
    kept = add_peak(peaks_file(wants.paths), peak)
    return f"Peak {kept.number} of the calibration: {kept.target}, good to {kept.sigma_deg:.2f}°."
