"""From the options of `birdcage scan` to what the station is asked for."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import click

from birdcage.cli.range_type import Range, RangeType
from birdcage.cli.source_where import named, path_from
from birdcage.skymap.map_file import MapHead, list_maps
from birdcage.skymap.map_request import MapRequest, again, usual_step_deg, within_reach
from birdcage.skymap.map_times import typed_times
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.station.state import StationState

AROUND_BEAMS = 2.5
"""A map around a moving target goes so many widths of the beam to each side."""
MOST_PATH_S = 6.0 * 3600.0
"""So far ahead it is computed where a target will be: until then the map is done, or is resumed."""


@dataclass(frozen=True, slots=True)
class ScanOptions:
    """What was typed."""

    az: Range | None
    el: Range | None
    step_deg: float | None
    order: str
    around: str
    start: str
    until: str
    reference: str
    reference_every_min: float
    reads: int
    details: bool
    quiet: bool
    source: str


def request_of(options: ScanOptions, wants: Wanted, state: StationState) -> MapRequest:
    """Return what is to be made. click.UsageError with a sentence for what makes no map."""
    now_s = time.time()
    start_s, until_s = _times(options, now_s)
    try:
        plan = within_reach(_plan(options, state), state)
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    around = named((options.around,), wants) if options.around else None
    return MapRequest(
        plan, target="" if around is None else around.name,
        path=_path(options.around, wants, max(start_s, now_s)) if options.around else (),
        source=options.source, reads=options.reads, details=options.details, start_s=start_s, until_s=until_s,
        reference=_reference(options.reference, wants, now_s), reference_every_s=options.reference_every_min * 60.0,
        quiet=options.quiet,
    )  # fmt: skip


def _plan(options: ScanOptions, state: StationState) -> MapPlan:
    step_deg = options.step_deg or usual_step_deg(state)
    az, el, frame = options.az, options.el, MapFrame.AZEL
    if options.around:
        reach_deg = step_deg * round(AROUND_BEAMS * 3.0)
        az, el, frame = az or (-reach_deg, reach_deg), el or (-reach_deg, reach_deg), MapFrame.TARGET
    if az is None or el is None:
        raise ValueError("Which part of the sky? Give --az 160:220 --el 25:50, or --around sun.")
    if az[1] < az[0] and frame is MapFrame.AZEL:
        az = az[0], az[1] + 360.0  # over north: 350:10
    return MapPlan(*az, *el, step_deg, MapOrder(options.order), frame)


def _path(around: str, wants: Wanted, begin_s: float) -> tuple[tuple[float, ...], ...]:
    return tuple(path_from(named((around,), wants), wants, begin_s, MOST_PATH_S, whole=False).rows)


def _reference(text: str, wants: Wanted, now_s: float) -> tuple[float, float] | None:
    """Return a direction: `170:40`, or that of a target that stands still on the sky."""
    if not text:
        return None
    if ":" in text:
        return RangeType().convert(text, None, None)
    path = path_from(named((text,), wants), wants, now_s, 3600.0)
    if len(path.rows) > 1 and path.moves_deg_s(now_s + 1800.0, 3600.0) * 3600.0 > 0.5:
        raise click.UsageError(f"{text} moves on the sky: as a reference it tells no drift. Name a satellite slot.")
    return path.at(now_s)


def resumed(number: str, options: ScanOptions, wants: Wanted) -> tuple[MapRequest, MapHead]:
    """Return what goes on with an unfinished map: of this number, or the newest one for `newest`.

    click.UsageError where there is none, or for options that would make another map of it.
    """
    begun = {"--az": options.az, "--el": options.el, "--step": options.step_deg, "--around": options.around,
             "--reference": options.reference, "--reads": options.reads, "--details": options.details,
             "--quiet": options.quiet}  # fmt: skip
    if given := [name for name, value in begun.items() if value]:
        raise click.UsageError(f"--resume goes on with a map as it was begun. Leave {given[0]} out.")
    heads = [head for head in list_maps(wants.paths.signal_recordings) if head.ended is None]
    if number != "newest":
        heads = [head for head in heads if str(head.number) == number]
    if not heads:
        which = "No map is unfinished." if number == "newest" else f"No unfinished map has the number {number}."
        raise click.UsageError(f"{which} `birdcage maps` lists them.")
    head, now_s = heads[0], time.time()
    start_s, until_s = _times(options, now_s)
    path: tuple[tuple[float, ...], ...] = ()
    if head.plan.frame is MapFrame.TARGET:
        path = _path(str(head.about.get("target")), wants, max(start_s, now_s))
    return replace(again(head, path), start_s=start_s, until_s=until_s), head


def fresh(request: MapRequest, wants: Wanted) -> MapRequest:
    """Return the request for another map of the same kind, from now on."""
    path = _path(request.target, wants, time.time()) if request.path else ()
    return replace(request, key="", start_s=0.0, path=path)


def still_time(request: MapRequest) -> bool:
    """Return whether the time to end has not come yet."""
    return not request.until_s or time.time() < request.until_s


def _times(options: ScanOptions, now_s: float) -> tuple[float, float]:
    try:
        return typed_times(options.start, options.until, now_s)
    except ValueError as error:
        raise click.UsageError(str(error)) from error
