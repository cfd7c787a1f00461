"""`birdcage acquire`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted
from birdcage.cli.source_option import heard_by, source_option

if TYPE_CHECKING:
    from birdcage.cli.station_command import StationCommand
    from birdcage.signal.acquired import Acquired
    from birdcage.signal.slots_heard import SlotSeen

HOLDER = "birdcage acquire"
TAKES_S = 1800.0
"""How long a search may take: hundreds of directions, some seconds each on a slow dish."""
SHOWN = 4
"""Of the satellites that it may be."""


@click.command("acquire", epilog=exits.EPILOG)
@click.argument("target", nargs=-1, required=True)
@click.option("--within", "reach_az_deg", metavar="DEG", type=click.FloatRange(0.0, 180.0), default=15.0,
              show_default=True, help="How far to the sides to search: how well north is known.")  # fmt: skip
@click.option("--up-down", "reach_el_deg", metavar="DEG", type=click.FloatRange(0.0, 45.0), default=5.0,
              show_default=True, help="How far up and down: how level the base stands.")  # fmt: skip
@click.option("--set-north", is_flag=True, help="What is found is TARGET: write its offsets into birdcage.toml.")
@source_option
@global_options()
@click.pass_context
def command(
    context: click.Context, target: tuple[str, ...], reach_az_deg: float, reach_el_deg: float, set_north: bool,
    source: str | None,
) -> None:  # fmt: skip
    """Find TARGET, a geostationary satellite, near where it should be. Ctrl+C stops the dish.

    The dish goes to the predicted direction, measures the floor, and goes outwards in half-beam steps until the signal
    stands out. It peaks there, and tells what its receiver says: lock, SNR, network. Satellites that this may be are
    listed. With --set-north the offsets of the alignment are set by what was found. Without a signal the exit status
    is 1.
    """
    from birdcage.cli.attached_command import reach_dish
    from birdcage.cli.say import say, tell, tell_json

    wants = wanted()
    by = heard_by(source, wants.settings)
    meant, slots = _slot(target, wants)
    with reach_dish(wants, HOLDER, moves=True) as dish:
        found = _search(dish, meant, slots, (reach_az_deg, reach_el_deg), by)
        demo = dish.state.demo
    if isinstance(found, str):
        say(found)
        context.exit(exits.NOT_DONE)
    if flags().json:
        tell_json({**_values(found, meant, wants), "demo": demo})
    else:
        tell(f"Found at {found.az_deg:.2f}°/{found.el_deg:.2f}° ±{found.sigma_deg:.2f}°: {found.heard}.")
    _tell_who(found, meant, wants, set_north=set_north)


def _slot(target: tuple[str, ...], wants: Wanted) -> tuple[SlotSeen, tuple[SlotSeen, ...]]:
    """Return the slot that is meant, and all that may be heard. click.UsageError for any other target."""
    from birdcage.cli.named_target import find_target
    from birdcage.cli.say import say
    from birdcage.cli.sky_options import find_observer
    from birdcage.signal.slots_heard import seen_at, seen_from
    from birdcage.sky.targets.model import SlotTarget

    named = find_target(target, wants.paths, None, say).target
    if not isinstance(named, SlotTarget):
        raise click.UsageError(f"{named.name} is no geostationary satellite. Name one: `birdcage acquire 119W`.")
    observer, refraction = find_observer(wants.settings, None, None, None), wants.settings.tracking.refraction
    meant = seen_at(named.slot, observer, refraction)
    if meant is None:
        raise click.UsageError(f"{named.name} is below the horizon here, always.")
    others = [each for each in seen_from(observer, refraction) if each.slot != meant.slot]
    return meant, (meant, *others)


def _search(
    dish: StationCommand,
    meant: SlotSeen,
    slots: tuple[SlotSeen, ...],
    reach_deg: tuple[float, float],
    by: str,
) -> Acquired | str:
    """Have the dish find it; return what was found, or why nothing was."""
    from birdcage.cli.say import say
    from birdcage.cli.signal_task import follow_task, ready_dish
    from birdcage.signal.acquire_task import AcquireTask, values_for
    from birdcage.signal.acquired import acquired

    _position, width_deg = ready_dish(dish, by, named=True)
    say(f"{meant.slot.label} {meant.slot.name} should be at {meant.az_deg:.2f}°/{meant.el_deg:.2f}°.")
    facts = dish.state.dish
    values = {
        "source": by,
        **values_for(meant, slots, reach_deg, width_deg, () if facts is None else tuple(facts.features)),
    }
    ended = follow_task(dish, AcquireTask.kind, values, HOLDER, TAKES_S, "{} of at most {} directions heard …")
    if not ended.found:
        return ended.why
    dish.look_anew()
    position = dish.state.position
    assert position is not None, "it has just come to rest"
    return acquired(ended.found, position, slots, reach_deg[0])


def _values(found: Acquired, meant: SlotSeen, wants: Wanted) -> dict[str, object]:
    az_deg, el_deg = found.offsets(meant, wants.settings.active_feed)
    return {
        **found.told, "may_be": [each.slot.longitude_deg for each in found.may_be],
        "az_offset_deg": az_deg, "el_offset_deg": el_deg,
    }  # fmt: skip


def _tell_who(found: Acquired, meant: SlotSeen, wants: Wanted, *, set_north: bool) -> None:
    """Say which satellites it may be, and set north by it, or say how."""
    from birdcage.cli.say import say

    likeliest = found.may_be[:SHOWN]
    if meant not in found.may_be:
        names = ", ".join(each.slot.label for each in likeliest)
        may_be = f"It may be {names}." if names else "No known satellite fits: are place and level right?"
        say(f"By height and network this is not {meant.slot.label}. {may_be} Nothing was set.")
        return
    across, up = found.off(meant)
    aside, height = _ways(across, "right", "left"), _ways(up, "above", "below")
    say(f"If it is {meant.slot.label}, it was found {aside} of its place, {height}.")
    others = [each.slot.label for each in likeliest if each is not meant]
    if others:
        also = "It may also be" if likeliest[0] is meant else "By its place it is more likely"
        say(f"{also} {', '.join(others)}.")
    if set_north:
        say(_set(found, meant, wants))
    else:
        say(f"Is it {meant.slot.label}? The same with --set-north sets the alignment by it.")


def _ways(deg: float, more: str, less: str) -> str:
    return f"{abs(deg):.2f}° {more if deg >= 0.0 else less}"


def _set(found: Acquired, meant: SlotSeen, wants: Wanted) -> str:
    """Write the offsets, and say so. ConfigError where that can't be done."""
    from birdcage.base.alignments import north_settings
    from birdcage.base.config import edit

    az_deg, el_deg = found.offsets(meant, wants.settings.active_feed)
    changes, remark = north_settings(wants.settings.alignment, az_deg, el_deg)
    edit(wants.paths.config_file, changes)
    return f"Set: az offset {az_deg:+.2f}°, el offset {el_deg:+.2f}°{remark}. Programs take it at their next start."
