"""`birdcage move`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import Wanted, flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, elements_option, no_options_among

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.cli.station_command import StationCommand
    from birdcage.station.events import Event
    from birdcage.station.requests import Goto

TOLD_DEG = 0.01
"""A miss of less is not told: angles are shown in hundredths."""
HOLDER = "birdcage move"


@click.command("move", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--az", "az_deg", type=float, help="Azimuth in degrees, clockwise from true north.")
@click.option("--el", "el_deg", type=float, help="Elevation of the beam in degrees; no refraction is added.")
@click.option("--leapfrog/--no-leapfrog", help="Aim beyond the target, as older scripts do.  [default: exact]")
@click.option("--clamp", is_flag=True, help="Go to the nearest allowed elevation instead of refusing.")
@click.option("--no-wait", is_flag=True, help="Return once the dish has taken the target; don't watch the motion.")
@click.option("--timeout", "timeout_s", type=click.FloatRange(1.0, 3600.0), default=120.0, show_default=True,
              help="Seconds until the move counts as failed and is stopped.")  # fmt: skip
@elements_option
@global_options()
def command(
    target: tuple[str, ...], az_deg: float | None, el_deg: float | None, leapfrog: bool, clamp: bool, no_wait: bool,
    timeout_s: float, elements: Path | None,
) -> None:  # fmt: skip
    """Point the dish at --az and --el, or at where TARGET stands now, and wait until it is there. Ctrl+C stops it.

    TARGET is named as for `birdcage where`: 180 45, moon, 28.2E, dish 119, iss. The dish goes there once and stays:
    `birdcage track TARGET --engage` follows. For a target refraction is added, as `tracking.refraction` sets it; for
    angles that you give it is not. If another birdcage program has the port, that one moves the dish.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import position_lines, position_values, say, tell, tell_json
    from birdcage.station.requests import Goto
    from birdcage.station.state import Pointing

    no_options_among(target)
    wants = wanted()
    az_deg, el_deg = direction_to(target, az_deg, el_deg, wants, elements)
    with reach_dish(wants, HOLDER, moves=True) as dish:
        dish.come_up(15.0)
        if leapfrog:
            az_deg, el_deg = _beyond(dish, az_deg, el_deg)
        request = Goto(az_deg, el_deg, HOLDER, clamp=clamp)
        if no_wait:
            _begin(dish, request, timeout_s)
            return
        arrived = dish.ask(request, timeout_s, MoveShown(dish))
        miss_deg = dish.state.target_miss_deg
    assert isinstance(arrived, Pointing), "a go-to resolves with the position at arrival"
    if flags().json:
        tell_json({**position_values(arrived), "miss_deg": round(miss_deg, 3), "demo": dish.state.demo})
    else:
        tell(position_lines(arrived))
    if miss_deg >= TOLD_DEG:
        say(f"That is the nearest it reaches: {miss_deg:.2f}° from the direction asked for.")
    if arrived.modelled:
        say("It should have arrived. At rest the dish does not tell.")


def direction_to(
    words: tuple[str, ...], az_deg: float | None, el_deg: float | None, wants: Wanted, elements: Path | None
) -> tuple[float, float]:
    """Return where to, true: the two angles, or where the target stands now, refraction included as set.

    click.UsageError for neither or both. MotionRefused, reason ``below_horizon``, for a target that is not up.
    """
    from datetime import UTC, datetime

    from birdcage.base.errors import MotionRefused
    from birdcage.cli.named_target import find_target
    from birdcage.cli.say import say
    from birdcage.cli.sky_options import find_observer
    from birdcage.sky.targets.model import Fixed, SlotTarget
    from birdcage.sky.targets.sight import below_words
    from birdcage.tracking.planning.refraction import lift_deg

    if not words:
        if az_deg is None or el_deg is None:
            raise click.UsageError(
                "Give --az and --el, or name a target: `birdcage move 180 45`, `birdcage move moon`."
            )
        if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
            raise click.UsageError("--az and --el must be numbers.")
        return az_deg, el_deg
    if az_deg is not None or el_deg is not None:
        raise click.UsageError("Give a target, or --az and --el, not both.")
    target = find_target(words, wants.paths, elements, say).target
    if isinstance(target, Fixed):
        return target.az_deg, target.el_deg
    observer, now = find_observer(wants.settings, None, None, None), datetime.now(UTC)
    below = below_words(target, observer, now)
    if below:
        text = " ".join(words)
        raise MotionRefused(
            f"{below} Nothing moves. `birdcage track {text}` shows what is to come.", reason=Reason.BELOW_HORIZON
        )
    seen = target.look(observer, now)
    el_deg = seen.el_deg + float(lift_deg(seen.el_deg, wants.settings.tracking.refraction))
    refraction = wants.settings.tracking.refraction
    lifted = "without refraction" if refraction == "none" else f"{refraction} refraction included"
    say(f"{target.name}: AZ {seen.az_deg:.2f}° EL {el_deg:.2f}° now, {lifted}.")
    skew = target.skew(observer) if isinstance(target, SlotTarget) else None
    if skew is not None:
        say(f"{skew.brief()}, clockwise from behind the dish.")
    return seen.az_deg, el_deg


def _beyond(dish: StationCommand, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Apply the fixed overshoot of `birdcage.leapfrog` against the position that was just read."""
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


def _begin(dish: StationCommand, request: Goto, timeout_s: float) -> None:
    """Wait until the dish has taken the target, and leave it moving."""
    from birdcage.cli.say import say
    from birdcage.rotator.ladder import StopMeans
    from birdcage.station.events import MoveStarted
    from birdcage.station.stop_words import stop_line

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
    motion, stops = dish.state.motion, stop_line(dish.state, dish.now).rstrip(".")
    how = "" if motion is None or motion.stop_means is StopMeans.NONE else " `birdcage stop` calls STOP."
    say(f"On its way to AZ {request.az_deg:.2f}° EL {request.el_deg:.2f}°. {stops}.{how}")


class MoveShown:
    """Shows how far it is on a terminal."""

    def __init__(self, dish: StationCommand) -> None:
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
