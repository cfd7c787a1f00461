"""`birdcage track`."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from birdcage.base.reason import Reason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import DEMO_FIRMWARE, flags, global_options
from birdcage.cli.sky_options import (
    FREQUENCY,
    NEGATIVE_NUMBERS,
    UTC_TIME,
    elements_option,
    find_observer,
    no_options_among,
    observer_options,
)

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.pursuit.chosen_target import ChosenTarget
    from birdcage.pursuit.desk_setup import ControllerName
    from birdcage.sky.made_up_pass import PassWish
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target
    from birdcage.tracking.mount import Mount

NOT_THERE = "--lat, --lon, --alt and --controller"
CONTROLLERS = ("auto", "fast", "velocity", "queued", "modelled", "leapfrog")


ANY_PLACE = (45.0, 0.0, 0.0)
_NO_DISH = "A plan needs to know the dish. Give --firmware, or set firmware under [dish] in birdcage.toml."


class Until(click.ParamType["str | datetime"]):
    """`LOS`, `reach`, or a time."""

    name = "WHEN"

    def convert(
        self, value: str | datetime, param: click.Parameter | None, ctx: click.Context | None
    ) -> Literal["los", "reach"] | datetime:
        """Return which."""
        word = value.casefold() if isinstance(value, str) else value
        if word == "los":
            return "los"
        return "reach" if word == "reach" else UTC_TIME.convert(value, param, ctx)


@click.command("track", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("target", nargs=-1)
@click.option("--synthetic", is_flag=True, help="Follow a made-up pass, without TARGET, elements or network.")
@click.option("--max-el", "max_el_deg", type=click.FloatRange(5.0, 90.0), metavar="DEG",
              help="Greatest elevation of the made-up pass.  [default: 60]")  # fmt: skip
@click.option("--minutes", type=click.FloatRange(1.0, 60.0), metavar="MIN",
              help="How long the made-up pass lasts, from rise to set.  [default: 10]")  # fmt: skip
@click.option("--rises-in", "rises_in_s", type=click.FloatRange(0.0, 3600.0), metavar="S",
              help="Seconds until the made-up pass rises.  [default: 60]")  # fmt: skip
@click.option("--plan", "plan_only", is_flag=True, help="Print the plan and nothing else.")
@click.option("--engage", is_flag=True, help="Move the dish: go there in time, wait, follow, and park as set.")
@click.option("--until", type=Until(), help="When to end: LOS (all of the pass, and parking), reach (when it goes out "
              "of reach), or a time.  [default: LOS]")  # fmt: skip
@click.option("--controller", type=click.Choice(CONTROLLERS), help="What steers.  [default: as set, or auto]")
@click.option("--time-offset", "time_offset_s", type=click.FloatRange(-3600.0, 3600.0), metavar="S",
              help="Seconds that it comes later than computed.  [default: as the catalogue remembers]")  # fmt: skip
@click.option("--freq", "freq_hz", type=FREQUENCY, help="Its downlink: 137.1M; a bare number is in MHz.  "
              "[default: the first one that the feed hears]")  # fmt: skip
@click.option(
    "--speed", type=click.FloatRange(1.0, 1000.0), help="Run time this many times faster; simulated dish only."
)
@elements_option
@observer_options
@global_options(firmware="as set, else none: --engage asks the port, a plan needs one")
def command(
    target: tuple[str, ...], synthetic: bool, max_el_deg: float | None, minutes: float | None,
    rises_in_s: float | None, plan_only: bool, engage: bool, until: Literal["los", "reach"] | datetime | None,
    controller: ControllerName | None, time_offset_s: float | None, freq_hz: float | None, speed: float | None,
    elements: Path | None, lat: float | None, lon: float | None, alt: float | None,
) -> None:  # fmt: skip
    """Follow TARGET with the dish, or show the plan.

    TARGET is named as for `birdcage where`: iss, AO-91, 25544, sun, polaris, 28.2E, dish 119, ra=5h34m,dec=+22d.
    Without --engage nothing is opened and nothing moves: the next pass that comes into reach is planned for the dish
    that --firmware names. Elevations of the plan include refraction as `tracking.refraction` sets it: radio, optical or
    none. With --engage the dish must be homed, and Ctrl+C stops it. If another birdcage program has the port, that one
    follows, from its own place; if this command ends without Ctrl+C, that goes on.
    --synthetic makes a pass up instead of TARGET, for the place that is set, or any: a test of the machine by itself.
    """
    from datetime import UTC

    from birdcage.cli.named_target import find_target
    from birdcage.cli.options import wanted
    from birdcage.cli.say import say
    from birdcage.cli.track_run import synthetic as synthetic_pass
    from birdcage.sky.made_up_pass import PassWish

    no_options_among(target)
    if engage and plan_only:
        raise click.UsageError("--plan moves nothing, --engage does: give one of them.")
    if not engage and (until or controller or speed):
        raise click.UsageError("--until, --controller and --speed go with --engage.")
    wants = wanted()
    if speed is not None and not wants.port.startswith("sim:"):
        raise click.UsageError(f"--speed is for a simulated dish only. Give --port sim:{DEMO_FIRMWARE} with it.")
    wish = _wish(target, max_el_deg, minutes, rises_in_s, elements) if synthetic else None
    if wish is None:
        if any(each is not None for each in (max_el_deg, minutes, rises_in_s)):
            raise click.UsageError("--max-el, --minutes and --rises-in go with --synthetic.")
        if not target:
            raise click.UsageError("Name a TARGET, or give --synthetic.")
    observer = find_observer(wants.settings, lat, lon, alt) if wish is None else _any_place(wants, lat, lon, alt)
    meant = find_target(target, wants.paths, elements, say).target if wish is None else wish
    text = " ".join(target) if wish is None else "synthetic"
    if engage:
        from birdcage.base.clock import RealClock, ScaledClock
        from birdcage.cli.attached_command import reach_dish
        from birdcage.cli.desk_elsewhere import DeskElsewhere
        from birdcage.cli.track_run import HOLDER, TrackOrder, follow

        order = TrackOrder(text, meant, observer, controller, time_offset_s, freq_hz, until or "los", flags().json)
        clock = RealClock() if speed is None else ScaledClock(speed)
        with reach_dish(wants, HOLDER, moves=True, clock=clock, attached=DeskElsewhere) as dish:
            if isinstance(dish, DeskElsewhere) and (lat is not None or controller):
                raise click.UsageError(f"{dish.station.via} follows from its own place. Leave out {NOT_THERE}.")
            follow(dish, wants, order)
        return
    if isinstance(meant, PassWish):
        meant = synthetic_pass(meant, datetime.now(UTC), observer)
    _show(text, meant, wants, observer, time_offset_s, freq_hz, plan_only=plan_only)


def _wish(
    target: tuple[str, ...], max_el_deg: float | None, minutes: float | None, rises_in_s: float | None,
    elements: Path | None,
) -> PassWish:  # fmt: skip
    """Return the pass that the options ask for. OutOfRange, before anything is opened, where no orbit makes it."""
    from birdcage.sky.made_up_pass import PassWish, checked

    if target or elements is not None:
        raise click.UsageError("--synthetic makes a pass up: leave out TARGET and --elements.")
    usual = PassWish()
    return checked(PassWish(
        usual.max_el_deg if max_el_deg is None else max_el_deg,
        usual.duration_s if minutes is None else minutes * 60.0,
        usual.rises_in_s if rises_in_s is None else rises_in_s,
    ))  # fmt: skip


def _any_place(wants: Wanted, lat: float | None, lon: float | None, alt: float | None) -> Observer:
    """Return where the dish stands; where that is not set, any place: a made-up pass is the same anywhere."""
    from birdcage.sky.observer import Observer

    if lat is None and lon is None and wants.settings.place.latitude_deg is None:
        return Observer(*ANY_PLACE)
    return find_observer(wants.settings, lat, lon, alt)


def _show(
    text: str, target: Target, wants: Wanted, observer: Observer, time_offset_s: float | None, freq_hz: float | None,
    *, plan_only: bool,
) -> None:  # fmt: skip
    """Print the plan, and before it where the target stands now."""
    from datetime import UTC

    from birdcage.cli.named_target import tell_below
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.where_report import Report
    from birdcage.sky.targets.model import Satellite
    from birdcage.tracking.plan_values import plan_values
    from birdcage.tracking.plan_words import plan_lines

    now = datetime.now(UTC)
    if not isinstance(target, Satellite):
        tell_below(target, observer, now, say)  # of a satellite the plan tells its next pass
    choice = _choice_for(text, target, wants, time_offset_s=time_offset_s, freq_hz=freq_hz)
    _plan_for(choice, wants, observer, now)
    assert choice.plan is not None, "one was made"
    if flags().json:
        tell_json(plan_values(choice.plan))
        return
    if not plan_only:
        for line in Report.of(target, observer, now, wants).lines():
            tell(line)
        tell("")
    for line in plan_lines(choice.plan):
        tell(line)
    if not plan_only:
        say("Nothing moved. --engage follows it.")


def _choice_for(
    text: str, target: Target, wants: Wanted, *, time_offset_s: float | None, freq_hz: float | None
) -> ChosenTarget:
    """Return a target as the desk chooses it, with what the options say of it."""
    from birdcage.pursuit.choosing import choice_of, listen_at

    choice = choice_of(text, target, None)
    listen_at(choice, wants.settings, wants.paths.downlinks_file)
    choice.wanted_hz = freq_hz
    if time_offset_s is not None:
        choice.time_offset_s = time_offset_s
    return choice


def _plan_for(choice: ChosenTarget, wants: Wanted, observer: Observer, now: datetime) -> None:
    """Plan, with the share of a dish whose axes move in turn. BirdcageError where that cannot be done."""
    from birdcage.base.errors import BirdcageError
    from birdcage.pursuit.circumstances import Circumstances
    from birdcage.pursuit.follower import options_of
    from birdcage.pursuit.refiner import refined

    at = Circumstances(now, observer, _mount_for(wants), wants.settings)
    choice.refresh(at)
    if choice.plan is None:
        raise BirdcageError(choice.problem, reason=Reason.NO_PLAN)
    choice.plan = refined(
        choice.plan, at.mount, options_of(wants.settings), wants.settings.tracking.preposition_s
    )  # fmt: skip


def _mount_for(wants: Wanted) -> Mount:
    """Return the dish that was named, as it is where nothing is known of it but its kind. ConfigError without one."""
    from birdcage.base.beam import beam_of
    from birdcage.base.errors import ConfigError
    from birdcage.station.reach_limits import reach_limits
    from birdcage.station.settings import rules_from
    from birdcage.tracking.mount import Mount

    model, rules = wants.named_model, rules_from(wants.settings)
    if model is None:
        raise ConfigError(_NO_DISH)
    return Mount(
        model, reach_limits(wants.settings, model), rules.alignment, None,
        rules.min_elevation_deg, rules.max_elevation_deg, beam_of(rules.feed, model.reflector),
    )  # fmt: skip
