"""`birdcage elements list` and `search`."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE, USAGE
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.sky.catalogue import CatalogueEntry, CatalogueGroup


@click.command("list", short_help="List groups and satellites, and how old they are.", epilog=DATA_EPILOG)
@click.argument("group", required=False)
@click.option("--all", "everything", is_flag=True, help="Every satellite of the catalogue.")
@click.option("--favourites", is_flag=True, help="Your favourites.")
@click.option("--groups", "fetchable", is_flag=True, help="Also the groups that could be fetched, and what they are.")
@global_options("config", "json", "verbose")
@click.pass_context
def list_(
    context: click.Context, group: str | None, everything: bool, favourites: bool, fetchable: bool
) -> None:  # fmt: skip
    """List the groups and how old they are; with the name of a group its satellites."""
    from birdcage.cli.commands.elements_common import EMPTY, open_catalogue, say_ahead
    from birdcage.cli.say import say

    now = datetime.now(UTC)
    with open_catalogue() as catalogue:
        groups, entries = catalogue.groups.all(), catalogue.entries()
    if not entries:
        say(EMPTY)
    say_ahead([each.elements for each in entries])
    if group is not None:
        wanted = next((each.name for each in groups if each.name.casefold() == group.casefold()), None)
        if wanted is None:
            say(f"No group is called {group} in the catalogue. `birdcage elements list --groups` shows what there is.")
            context.exit(USAGE)
        entries = tuple(each for each in entries if wanted in each.groups)
    if favourites:
        entries = tuple(each for each in entries if each.favourite)
    entries = tuple(sorted(entries, key=lambda each: (-each.priority, each.name.casefold())))
    if everything or favourites or group is not None:
        _tell_satellites(entries, now)
    else:
        _tell_groups(groups, entries, now, fetchable=fetchable)


@click.command("search", short_help="Find satellites by name, number, group or tag.", epilog=DATA_EPILOG)
@click.argument("text")
@click.option("--limit", type=click.IntRange(min=1), default=20, show_default=True, help="How many at most.")
@global_options("config", "json", "verbose")
@click.pass_context
def search(context: click.Context, text: str, limit: int) -> None:
    """Find satellites by name, another of their names, number, group or tag, best first."""
    from birdcage.cli.commands.elements_common import EMPTY, open_catalogue
    from birdcage.cli.options import find_paths
    from birdcage.cli.say import say
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.downlinks_read import load_downlinks
    from birdcage.sky.targets import Resolver

    with open_catalogue() as catalogue:
        resolver = Resolver(catalogue.index(), load_downlinks(find_paths().downlinks_file))
        hits = (each.hit for each in resolver.find(text))
        found = tuple(each for each in hits if isinstance(each, CatalogueEntry))[:limit]
        empty = not found and not catalogue.all()
        problem = "" if found or empty else resolver.resolve(text).problem
    if found or flags().json:
        _tell_satellites(found, datetime.now(UTC))
    if not found:
        say(EMPTY if empty else problem or f"Nothing in the catalogue resembles {text!r}.")
        context.exit(NOT_DONE)


def _tell_satellites(entries: Sequence[CatalogueEntry], now: datetime) -> None:
    from birdcage.cli.commands.elements_common import entry_values, tell_entries
    from birdcage.cli.say import tell_json

    if flags().json:
        tell_json([entry_values(each, now) for each in entries])
    elif entries:
        tell_entries(entries, now)


def _tell_groups(
    groups: Sequence[CatalogueGroup], entries: Sequence[CatalogueEntry], now: datetime, *, fetchable: bool
) -> None:
    from birdcage.cli.say import tell, tell_json
    from birdcage.cli.table import tell_table
    from birdcage.sky.catalogue import CatalogueGroup
    from birdcage.sky.catalogue.words import age, at
    from birdcage.sky.update.sources import GROUPS

    if fetchable:
        known = {each.name for each in groups}
        groups = [*groups, *(CatalogueGroup(name) for name in GROUPS if name not in known)]
    epochs = {each.name: sorted(e.elements.epoch for e in entries if each.name in e.groups) for each in groups}
    if flags().json:
        tell_json([_group_values(each, epochs[each.name], now) for each in groups])
        return
    rows = []
    for each in groups:
        typical = epochs[each.name][len(epochs[each.name]) // 2] if epochs[each.name] else None
        paused = each.paused_until is not None and each.paused_until > now
        state = f"paused until {at(each.paused_until, now)}. " if paused and each.paused_until is not None else ""
        state += each.problem or (GROUPS.get(each.name, "") if fetchable else "")
        rows.append(
            (each.name, str(each.count) if each.count else "-", age(each.fetched, now), age(typical, now), state)
        )
    if rows:
        tell_table(("GROUP", "SATELLITES", "FETCHED", "EPOCHS", ""), rows, right=" rrr")
    alone = sum(not each.groups for each in entries)
    if entries:
        tell(f"Satellites in all: {len(entries)}{f', {alone} of them in no group' if alone else ''}.")


def _group_values(group: CatalogueGroup, epochs: Sequence[datetime], now: datetime) -> dict[str, object]:
    from birdcage.cli.say import iso

    return {
        "group": group.name,
        "satellites": group.count,
        "fetched": iso(group.fetched),
        "age_s": None if group.fetched is None else round((now - group.fetched).total_seconds()),
        "checked": iso(group.checked),
        "oldest_epoch": iso(epochs[0]) if epochs else None,
        "median_epoch": iso(epochs[len(epochs) // 2]) if epochs else None,
        "newest_epoch": iso(epochs[-1]) if epochs else None,
        "paused_until": iso(group.paused_until),
        "problem": group.problem,
        "url": group.url or None,
    }
