"""`birdcage levels`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import find_paths, flags, global_options, load_settings
from birdcage.cli.sky_options import NEGATIVE_NUMBERS

if TYPE_CHECKING:
    from birdcage.signal.level_scale import KnownLevel, LevelScale

NONE_KEPT = "No levels are known. `birdcage levels set 401=0 445=12.5` makes a scale of two."


@click.group("levels", epilog=exits.DATA_EPILOG, invoke_without_command=True)
@click.pass_context
@global_options("config", "json", "verbose")
def command(context: click.Context) -> None:
    """Make decibels of counts by two levels that you know. Without more words, print what is kept.

    The tuner of a dish tells counts, on a scale that was never measured. Two levels with known decibels make one: cold
    sky is 0 dB, the same sky through an attenuator -10. A straight line joins them, which is an assumption. Beyond the
    two levels it is extrapolated, and `birdcage rssi` and F3 mark it.
    """
    if context.invoked_subcommand is None:
        _show()


@command.command("set", epilog=exits.DATA_EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("one", metavar="LEVEL=DB")
@click.argument("other", metavar="LEVEL=DB")
@global_options("config", "json", "verbose")
def set_(one: str, other: str) -> None:
    """Keep two levels of the tuner with the mounted feed: 401=0 445=12.5."""
    from birdcage.base.config.signals import OWN_TUNER
    from birdcage.signal.level_scale import checked_scale, keep_scale

    paths = find_paths()
    feed = load_settings(paths).feed.active
    try:
        scale = checked_scale(OWN_TUNER, feed, _known_level(one), _known_level(other))
    except ValueError as wrong:
        raise click.UsageError(f"{wrong}.") from None
    keep_scale(paths.known_levels, scale)
    _tell(scale)


@command.command("remove", epilog=exits.DATA_EPILOG)
@global_options("config", "json", "verbose")
def remove() -> None:
    """Remove the levels of the tuner with the mounted feed: it tells counts alone again."""
    from birdcage.base.config.signals import OWN_TUNER
    from birdcage.cli.say import say
    from birdcage.signal.level_scale import find_scale, load_scales, remove_scale

    paths = find_paths()
    feed = load_settings(paths).feed.active
    scale = find_scale(load_scales(paths.known_levels).entries, OWN_TUNER, feed)
    if scale is None:
        raise click.UsageError(f"No levels are known of the tuner with the feed {feed}.")
    remove_scale(paths.known_levels, scale)
    say(f"Removed: {scale.words('counts')}.")


def _show() -> None:
    from birdcage.cli.say import say, tell_json
    from birdcage.signal.level_scale import load_scales

    found = load_scales(find_paths().known_levels)
    for problem in found.problems:
        say(problem)
    if flags().json:
        tell_json([_values(each) for each in found.entries])
        return
    for each in found.entries:
        _tell(each)
    if not found.entries and not found.problems:
        say(NONE_KEPT)


def _tell(scale: LevelScale) -> None:
    from birdcage.cli.say import tell, tell_json

    if flags().json:
        tell_json(_values(scale))
        return
    tell(f"{scale.source}, feed {scale.feed}: {scale.words('counts')} ({scale.db_per_step:.3f} dB a count)")


def _values(scale: LevelScale) -> dict[str, object]:
    return {
        "source": scale.source, "feed": scale.feed, "db_per_step": scale.db_per_step,
        "levels": [{"value": each.value, "db": each.db} for each in (scale.low, scale.high)],
    }  # fmt: skip


def _known_level(text: str) -> KnownLevel:
    """Return what `401=0` says. ValueError in words."""
    from birdcage.signal.level_scale import KnownLevel

    value, _sign, db = text.partition("=")
    try:
        return KnownLevel(float(value), float(db.lower().removesuffix("db")))
    except ValueError:
        raise ValueError(f"{text!r} is no level. Type 401=0: counts, an equals sign, decibels") from None
