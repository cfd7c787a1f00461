"""`birdcage elements favourite` and `offset`: what you say about a satellite."""

from __future__ import annotations

from datetime import UTC, datetime

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import flags, global_options
from birdcage.cli.sky_options import NEGATIVE_NUMBERS


@click.command("favourite", short_help="Mark favourites; set priorities and tags.", epilog=DATA_EPILOG)
@click.argument("satellites", metavar="[SATELLITE]...", nargs=-1)
@click.option("--off", is_flag=True, help="No longer a favourite.")
@click.option("--priority", type=click.IntRange(0, 9), help="Higher comes first; 0 is none.")
@click.option("--tag", "tags", multiple=True, metavar="TAG", help="Give it a tag; may be repeated.")
@click.option("--untag", "untags", multiple=True, metavar="TAG", help="Take a tag away; may be repeated.")
@global_options("config", "json", "verbose")
def favourite(
    satellites: tuple[str, ...], off: bool, priority: int | None, tags: tuple[str, ...], untags: tuple[str, ...]
) -> None:  # fmt: skip
    """Make satellites favourites, by number or name, and set their priority. Without a name: list them."""
    from birdcage.cli.commands.elements_common import entry_values, find_entry, open_catalogue, tell_entries
    from birdcage.cli.say import say, tell_json

    if not satellites and (off or priority is not None or tags or untags):
        raise click.UsageError("Name a satellite.")
    with open_catalogue() as catalogue:
        keys = [find_entry(catalogue, each).key for each in satellites]
        for key in keys:
            catalogue.set_favourite(key, not off)
            if priority is not None:
                catalogue.set_priority(key, priority)
            entry = catalogue.entry(key)
            if entry is not None and (tags or untags):
                catalogue.set_tags(key, [each for each in (*entry.tags, *tags) if each not in untags])
        shown = [catalogue.entry(key) for key in keys] if keys else list(catalogue.favourites())
    entries = [each for each in shown if each is not None]
    now = datetime.now(UTC)
    if flags().json:
        tell_json([entry_values(each, now) for each in entries])
    elif entries:
        tell_entries(entries, now)
    else:
        say("No favourites yet. `birdcage elements favourite NAME` adds one.")


@click.command(
    "offset",
    short_help="Show or set how much later than computed one comes.",
    epilog=DATA_EPILOG,
    context_settings=NEGATIVE_NUMBERS,
)
@click.argument("satellite")
@click.argument("seconds", required=False)
@global_options("config", "json", "verbose")
def offset(satellite: str, seconds: str | None) -> None:
    """Show or set how many SECONDS later than computed a satellite comes (-1.5: earlier; none: forget it).

    It is kept with its date, also when elements are replaced. Check it again after an update.
    """
    from birdcage.cli.commands.elements_common import find_entry, open_catalogue
    from birdcage.cli.say import tell

    with open_catalogue() as catalogue:
        key = find_entry(catalogue, satellite).key
        if seconds is not None:
            catalogue.set_time_offset(key, _seconds(seconds), now=datetime.now(UTC))
        entry = catalogue.entry(key)
    assert entry is not None
    if flags().json:
        from birdcage.cli.commands.elements_common import entry_values
        from birdcage.cli.say import tell_json

        tell_json(entry_values(entry, datetime.now(UTC)))
    elif entry.time_offset_s is None or entry.time_offset_set is None:
        tell(f"{entry.name}: no time offset.")
    else:
        later = "later" if entry.time_offset_s >= 0 else "earlier"
        old = ", before the current elements came" if entry.time_offset_set < entry.fetched else ""
        dated = f"set {entry.time_offset_set:%Y-%m-%d %H:%M} UTC{old}"
        tell(f"{entry.name}: {abs(entry.time_offset_s):g} s {later} than computed, {dated}.")


def _seconds(text: str) -> float | None:
    if text.casefold() in ("none", "off", "-"):
        return None
    try:
        seconds = float(text.replace(",", "."))
    except ValueError:
        raise click.UsageError(f"{text} is not a number of seconds. `none` forgets the offset.") from None
    if not abs(seconds) <= 3600.0:
        raise click.UsageError("A time offset is at most 3600 seconds.")
    return seconds
