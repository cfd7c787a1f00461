"""`birdcage elements add` and `remove`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.sky.formats import ParseResult

PASTED = "pasted"


@click.command("add", short_help="Add elements from files, folders, or stdin.", epilog=DATA_EPILOG)
@click.argument("paths", metavar="PATH|-...", nargs=-1, required=True, type=click.Path(allow_dash=True))
@click.option("--group", metavar="NAME", help="Put the satellites in a group of this name.")
@global_options("config", "json", "verbose")
@click.pass_context
def add(context: click.Context, paths: tuple[str, ...], group: str | None) -> None:
    """Take in elements from files, folders, or text pasted on stdin (-).

    TLE, OMM in JSON, CSV, XML or KVN, Gpredict's files: the format is found by itself. The newest elements of each
    satellite stay. Damaged lines are named and skipped.
    """
    from birdcage.cli.commands.elements_common import complaint_values, open_catalogue, say_ahead
    from birdcage.cli.say import say, tell, tell_json

    harvest = read_all(paths)
    for complaint in harvest.complaints:
        say(str(complaint))
    say_ahead(harvest.elements)
    with open_catalogue() as catalogue:
        added = catalogue.add(harvest.elements, group=group)
        for each in harvest.groups:
            catalogue.add_to_group(each.name, each.norad_ids)
    if flags().json:
        complaints = [complaint_values(each) for each in harvest.complaints]
        groups = [each.name for each in harvest.groups]
        tell_json({**added._asdict(), "groups": groups, "complaints": complaints})
    else:
        grouped = f" {len(harvest.groups)} groups." if harvest.groups else ""
        if harvest.elements or harvest.groups:
            tell(f"{added.new} new, {added.newer} with newer elements, {added.kept} unchanged.{grouped}")
        else:
            say("No elements found. The catalogue is unchanged.")
    if harvest.complaints or not (harvest.elements or harvest.groups):
        context.exit(NOT_DONE)


def read_all(paths: tuple[str, ...]) -> ParseResult:
    """Return what files, folders and stdin (-) hold."""
    from pathlib import Path

    from birdcage.cli.say import say
    from birdcage.sky.formats import ParseResult, read_path, read_text
    from birdcage.sky.formats.read import LARGEST_FILE

    harvests = []
    for path in paths:
        if path != "-":
            harvests.append(read_path(Path(path)))
            continue
        if sys.stdin.isatty():
            say("Paste the elements, then Ctrl+D on a line of its own.")
        pasted: bytes = sys.stdin.buffer.read(LARGEST_FILE + 1)
        if len(pasted) > LARGEST_FILE:
            raise click.UsageError(f"This is more than {LARGEST_FILE / 1e6:.0f} MB, too much for a list of elements.")
        harvests.append(read_text(pasted.decode("utf-8-sig", "replace"), PASTED))
    return ParseResult(
        tuple(each for harvest in harvests for each in harvest.elements),
        tuple(each for harvest in harvests for each in harvest.complaints),
        tuple(each for harvest in harvests for each in harvest.groups),
    )


@click.command("remove", short_help="Take satellites out.", epilog=DATA_EPILOG)
@click.argument("satellites", metavar="[SATELLITE]...", nargs=-1)
@click.option("--older-than", metavar="DAYS", type=click.FloatRange(min=0), help="All whose epoch is older than that.")
@global_options("config", "json", "verbose")
def remove(satellites: tuple[str, ...], older_than: float | None) -> None:
    """Take satellites out of the catalogue, by number or name.

    Favourites, tags and notes are kept in case they come back.
    """
    from datetime import UTC, datetime, timedelta

    from birdcage.cli.commands.elements_common import find_entry, open_catalogue
    from birdcage.cli.say import tell, tell_json

    if not satellites and older_than is None:
        raise click.UsageError("Name a satellite, or give --older-than DAYS.")
    with open_catalogue() as catalogue:
        keys = [find_entry(catalogue, each).key for each in satellites]
        if older_than is not None:
            limit = datetime.now(UTC) - timedelta(days=older_than)
            keys += [each.key for each in catalogue.entries() if each.elements.epoch < limit]
        removed = catalogue.remove(keys)
    if flags().json:
        tell_json({"removed": removed})
    else:
        tell(f"{removed} removed.")
