"""`birdcage step-track`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from birdcage.station.task_state import TaskState, TaskValue

HOLDER = "birdcage step-track"


@click.command("step-track", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--every", "every_s", metavar="SECONDS", type=click.FloatRange(30.0, 86400.0), default=900.0,
              show_default=True, help="A peak at least so often.")  # fmt: skip
@click.option("--hours", type=click.FloatRange(0.01, 240.0), default=24.0, show_default=True, help="How long.")
@click.option("--name", default=None, help="Remember its way under this name.  [default: that of TARGET]")
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, target: tuple[str, ...], every_s: float, hours: float, name: str | None,
    source: str | None,
) -> None:  # fmt: skip
    """Stay on an inclined satellite by its signal alone. Ctrl+C stops the dish.

    The dish finds the peak about TARGET, or about where it points now. Small peaks follow now and then. Between them
    the dish goes where the satellite should be. Its way repeats every sidereal day: what was found is remembered for
    five days, so peaks become rare. A satellite that is not heard three times in a row ends it, with exit status 1.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import say
    from birdcage.cli.signal_task import follow_task, known_slots, ready_dish
    from birdcage.cli.source_where import path_now
    from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
    from birdcage.signal.slots_heard import patterns_near
    from birdcage.signal.step_track_task import StepTrackTask

    no_options_among(target)
    wants = wanted()
    by = heard_by(source, wants.settings)
    meant, path_at = path_now(target, wants, 60.0)
    with reach_dish(wants, HOLDER, moves=True) as dish:
        position, width_deg = ready_dish(dish, by, named=meant is not None)
        path = path_at(position)
        az_deg, el_deg = path.at(path.begin_s)
        values: dict[str, TaskValue] = {
            "az_deg": az_deg, "el_deg": el_deg, "width_deg": width_deg, "every_s": every_s, "hours": hours,
            "name": name or (meant.name if meant else ""), "source": by,
            "patterns": patterns_near(az_deg, el_deg, known_slots(wants), width_deg or ASSUMED_WIDTH_DEG),
        }  # fmt: skip
        takes_s = hours * 3600.0 + 1800.0
        peaks = _Peaks(demo=dish.state.demo)
        ended = follow_task(dish, StepTrackTask.kind, values, HOLDER, takes_s, "On it …", peaks.show)
    say(ended.why)
    if ended.found["lost"]:
        context.exit(exits.NOT_DONE)


class _Peaks:
    """Prints each peak once."""

    def __init__(self, *, demo: bool) -> None:
        self._told, self._demo = 0, demo

    def show(self, task: TaskState) -> None:
        """Print a new one."""
        from birdcage.cli.say import say, tell, tell_json

        peaks = task.found.get("peaks", 0)
        if not isinstance(peaks, int) or peaks <= self._told:
            return
        self._told = peaks
        if flags().json:
            tell_json({**task.found, "demo": self._demo})
            return
        az_deg, el_deg, sigma_deg = (task.found[each] for each in ("az_deg", "el_deg", "sigma_deg"))
        tell(f"Peak {peaks} at {az_deg:.2f}°/{el_deg:.2f}° ±{sigma_deg:.2f}°")
        if trouble := task.found.get("trouble"):
            say(str(trouble))
