"""`birdcage elements check`."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG, NOT_DONE
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.sky.age import ExpectedError
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.formats import Complaint


@click.command("check", short_help="Print how old elements are, and what in a file is damaged.", epilog=DATA_EPILOG)
@click.argument("paths", metavar="[PATH|-]...", nargs=-1, type=click.Path(allow_dash=True))
@click.option("--older-than", metavar="DAYS", type=click.FloatRange(min=0), help="Only those that are older.")
@global_options("config", "json", "verbose")
@click.pass_context
def check(context: click.Context, paths: tuple[str, ...], older_than: float | None) -> None:
    """Print epoch and age of each satellite, oldest first: of the catalogue, or of files.

    OFF is the pointing error at closest approach that elements of this age cause: typical, and 90 %. It comes from the
    statistics of such orbits. ● is fresh, ◐ usable, ○ doubtful, ✗ useless. *re-entered?* is what drag
    has taken down by its own elements, unless it was boosted.

    A line that cannot be read is named with its reason; the exit status is then 1.
    """
    from birdcage.cli.commands.elements_add import read_all
    from birdcage.cli.commands.elements_common import EMPTY, complaint_values, entry_values, open_catalogue, say_ahead
    from birdcage.cli.say import say, tell_json
    from birdcage.sky.age import error_values, expected_error
    from birdcage.sky.catalogue import CatalogueEntry

    now = datetime.now(UTC)
    complaints: Sequence[Complaint] = ()
    if paths:
        harvest = read_all(paths)
        complaints = harvest.complaints
        entries = tuple(CatalogueEntry(each, now) for each in harvest.elements)
    else:
        with open_catalogue() as catalogue:
            entries = catalogue.entries()
    for complaint in complaints:
        say(str(complaint))
    say_ahead([each.elements for each in entries])
    shown = sorted(entries, key=lambda each: each.elements.epoch)
    if older_than is not None:
        shown = [each for each in shown if (now - each.elements.epoch).total_seconds() > older_than * 86400]
    if flags().json:
        satellites = [{**entry_values(each, now), **error_values(expected_error(each.elements, now))} for each in shown]
        if paths:
            satellites = [{key: value for key, value in each.items() if key not in _OF_OURS} for each in satellites]
        tell_json({"satellites": satellites, "complaints": [complaint_values(each) for each in complaints]})
    else:
        _tell(shown, now)
    if not entries and not complaints:
        say("No elements found." if paths else EMPTY)
    else:
        say(_sum_up(entries, complaints, now))
    if complaints or (paths and not entries):
        context.exit(NOT_DONE)


_OF_OURS = ("fetched", "groups", "tags", "favourite", "priority", "time_offset_s", "time_offset_set")
"""What the catalogue knows of a satellite, and a file does not."""


def _tell(entries: Sequence[CatalogueEntry], now: datetime) -> None:
    from birdcage.cli.table import tell_table
    from birdcage.sky.age import expected_error
    from birdcage.sky.catalogue.words import age

    rows = [
        (
            str(each.norad_id or "-"), each.name or "-", f"{each.elements.epoch:%Y-%m-%d %H:%M:%S}",
            age(each.elements.epoch, now), _off(expected_error(each.elements, now)), each.elements.source or "-",
        )
        for each in entries
    ]  # fmt: skip
    if rows:
        tell_table(("NUMBER", "NAME", "EPOCH (UTC)", "AGE", "OFF", "SOURCE"), rows, right="r  r")


def _off(found: ExpectedError) -> str:
    from birdcage.sky.age_words import REENTERED, degrees

    if found.reentry is not None:
        return f"{found.glyph} {REENTERED}"
    if found.pointing_median_deg is None:
        return f"{found.glyph} not known"
    return f"{found.glyph} {degrees(found.pointing_median_deg)}, {degrees(found.pointing_p90_deg)}"


def _sum_up(entries: Sequence[CatalogueEntry], complaints: Sequence[Complaint], now: datetime) -> str:
    epochs = sorted(each.elements.epoch for each in entries)
    bad = f" {len(complaints)} damaged, named above and skipped." if complaints else ""
    if not epochs:
        return f"No satellites.{bad}"
    if len(epochs) == 1:
        return f"One satellite, {_old(epochs[0], now)}.{bad}"
    newest, half, oldest = (_old(epoch, now) for epoch in (epochs[-1], epochs[len(epochs) // 2], epochs[0]))
    return f"{len(epochs)} satellites: the newest {newest}, half of them {half} at most, the oldest {oldest}.{bad}"


def _old(epoch: datetime, now: datetime) -> str:
    from birdcage.sky.catalogue.words import span

    seconds = (now - epoch).total_seconds()
    return f"{span(seconds)} old" if seconds >= 0 else f"{span(-seconds)} ahead"
