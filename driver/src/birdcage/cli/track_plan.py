"""What `birdcage track` would do, by a plan for a dish that is not asked."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.base.reason import Reason

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.pursuit.chosen_target import ChosenTarget
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target
    from birdcage.tracking.mount import Mount

NO_DISH = "A plan needs to know the dish. Give --firmware, or set firmware under [dish] in birdcage.toml."


def choice_for(
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


def plan_for(choice: ChosenTarget, wants: Wanted, observer: Observer, now: datetime) -> None:
    """Plan, with the share of a dish whose axes move in turn. BirdcageError where that cannot be done."""
    from birdcage.base.errors import BirdcageError
    from birdcage.pursuit.circumstances import Circumstances
    from birdcage.pursuit.follower import options_of
    from birdcage.pursuit.refiner import refined

    at = Circumstances(now, observer, mount_for(wants), wants.settings)
    choice.refresh(at)
    if choice.plan is None:
        raise BirdcageError(choice.problem, reason=Reason.NO_PLAN)
    choice.plan = refined(
        choice.plan, at.mount, options_of(wants.settings), wants.settings.tracking.preposition_s
    )  # fmt: skip


def mount_for(wants: Wanted) -> Mount:
    """Return the dish that was named, as it is where nothing is known of it but its kind. ConfigError without one."""
    from birdcage.base.beam import beam_of
    from birdcage.base.errors import ConfigError
    from birdcage.station.reach_limits import reach_limits
    from birdcage.station.settings import rules_from
    from birdcage.tracking.mount import Mount

    model, rules = wants.named_model, rules_from(wants.settings)
    if model is None:
        raise ConfigError(NO_DISH)
    return Mount(
        model, reach_limits(wants.settings, model), rules.alignment, None,
        rules.min_elevation_deg, rules.max_elevation_deg, beam_of(rules.feed, model.reflector),
    )  # fmt: skip
