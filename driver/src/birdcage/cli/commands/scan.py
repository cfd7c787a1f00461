"""`birdcage scan`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.range_type import RangeType
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from birdcage.station.task_state import TaskState

HOLDER = "birdcage scan"
TAKES_S = 30.0 * 86400.0
"""A map ends by itself, by its time, or by STOP."""


@click.command("scan", epilog=exits.EPILOG)
@click.option("--az", type=RangeType(), help="Azimuths, true degrees: 160:220, or 350:10 over north.")
@click.option("--el", type=RangeType(), help="Elevations: 25:50.")
@click.option(
    "--around",
    metavar="TARGET",
    default="",
    help="Around a target that moves: sun, moon, a star, a "
    "satellite. --az and --el are then degrees right of it and above it.  [default: 2.5 beams to each side]",
)
@click.option(
    "--step",
    "step_deg",
    metavar="DEG",
    type=click.FloatRange(0.05, 90.0),
    help="Between two directions.  [default: a third of the beam]",
)
@click.option(
    "--order",
    type=click.Choice(["coarse", "rows", "columns", "spiral"]),
    default="coarse",
    show_default=True,
    help="coarse: from coarse to fine, so that the whole region is seen early.",
)
@click.option("--start", metavar="TIME", default="", help="Begin at 23:00 UTC, or at a time in ISO 8601.")
@click.option("--until", metavar="TIME", default="", help="Stop by this time. What was heard is kept.")
@click.option(
    "--reference",
    metavar="AZ:EL|SLOT",
    default="",
    help="A strong source at rest: a cross over it tells gain and pointing drift.",
)
@click.option(
    "--reference-every",
    "reference_every_min",
    metavar="MINUTES",
    type=click.FloatRange(1.0, 1440.0),
    default=60.0,
    show_default=True,
    help="How often.",
)
@click.option("--reads", metavar="N", type=click.IntRange(1, 1000), help="Readings in each direction.")
@click.option("--details", is_flag=True, help="Read SNR and lock of the dish's tuner in each direction, too.")
@click.option("--quiet", is_flag=True, help="Turn slowly: that is quieter, and takes longer.")
@click.option(
    "--repeat",
    metavar="N",
    type=click.IntRange(1, 1000),
    default=1,
    show_default=True,
    help="Make so many maps one after the other. `birdcage export --mean` averages them.",
)
@click.option(
    "--resume",
    is_flag=False,
    flag_value="newest",
    default=None,
    metavar="[MAP]",
    help="Go on with an unfinished map: the newest one, or the one of this number.",
)
@click.option("--estimate", "only_estimate", is_flag=True, help="Say how long it takes, and move nothing.")
@click.option(
    "--out",
    metavar="FOLDER",
    type=click.Path(file_okay=False),
    default=None,
    help="Write the map there as CSV, PNG, FITS and the text of earlier tools.",
)
@click.option("--blur-place", is_flag=True, help="Write whole degrees of latitude and longitude into the files.")
@source_option
@global_options()
def command(
    az: tuple[float, float] | None, el: tuple[float, float] | None, around: str, step_deg: float | None, order: str,
    start: str, until: str, reference: str, reference_every_min: float, reads: int | None, details: bool, quiet: bool,
    repeat: int, resume: str | None, only_estimate: bool, out: str | None, blur_place: bool, source: str | None,
) -> None:  # fmt: skip
    """Make a map of the sky: the signal in each direction of a region. Ctrl+C stops the dish.

    In each direction the dish stops, and its position and the signal are read. Every direction is on the disk at once,
    so --resume goes on with the next one, whatever cut the map short. Its region and settings stay; --start and --until
    count anew. `birdcage maps` lists maps, `birdcage export` writes them as files, and F3 shows them.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.scan_files import ScanFiles
    from birdcage.cli.scan_request import ScanOptions, fresh, request_of, resumed, still_time
    from birdcage.cli.signal_task import follow_task, ready_dish
    from birdcage.skymap.map_file import heard_so_far
    from birdcage.skymap.map_request import KIND, estimate

    wants = wanted()
    by = heard_by(source, wants.settings)
    options = ScanOptions(
        az, el, step_deg, order, around, start, until, reference, reference_every_min, reads or 0, details, quiet, by
    )
    going_on = None if resume is None else resumed(resume, options, wants)
    files = ScanFiles(wants.paths.signal_recordings, out, blur_place=blur_place)
    with files.written(), reach_dish(wants, HOLDER, moves=not only_estimate) as dish:
        ready_dish(dish, by if going_on is None else going_on[1].source, named=True)
        request = going_on[0] if going_on is not None else request_of(options, wants, dish.state)
        own = request.source == "tuner"
        heard, _points = heard_so_far(wants.paths.signal_recordings, request.key)
        told = estimate(request, dish.state, dwell_s=None if own else 1.0, heard=heard)
        say(f"{told.words}{_begins(request.start_s)}.")
        if only_estimate:
            return
        for turn in range(repeat):
            if turn and not still_time(request):
                break
            values = (request if not turn else fresh(request, wants)).values()
            files.key = str(values["key"])
            ended = follow_task(dish, KIND, values, HOLDER, TAKES_S, _progress, _Pauses().show)
            say(ended.why)
            if turn + 1 < repeat:
                files.write()
        if flags().json:
            tell_json({**ended.found, "heard": ended.done, "of": ended.of, "demo": dish.state.demo})


class _Pauses:
    """Says once why the map does not go on, and once more when it does."""

    def __init__(self) -> None:
        self._said = ""

    def show(self, task: TaskState) -> None:
        """Take in a change of the task."""
        from birdcage.cli.say import say

        pauses = task.phase.value in ("waiting", "yielded", "interrupted")
        words = task.why if pauses else "The map goes on." if self._said and task.phase.value == "running" else ""
        if words and words != self._said:
            say(words)
        self._said = task.why if pauses else ""


def _progress(task: TaskState) -> str:
    from birdcage.skymap.map_request import length_words

    left_s = task.found.get("left_s")
    left = f", {length_words(left_s)} left" if isinstance(left_s, float) else ""
    drift = ", the dish has lost steps" if task.found.get("lost_steps") else ""
    return f"{task.done} of {task.of} directions{left}{drift}"


def _begins(start_s: float) -> str:
    from datetime import UTC, datetime

    return f", from {datetime.fromtimestamp(start_s, UTC):%H:%M} UTC on" if start_s else ""
