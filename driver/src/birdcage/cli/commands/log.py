"""`birdcage log`."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import find_paths, flags, global_options
from birdcage.cli.sky_options import UTC_TIME

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.pursuit.pass_book import PassRecord

SHOWN = 20
"""Passes that are listed unless `--last` or `--since` says otherwise."""


@click.command("log", epilog=exits.EPILOG)
@click.argument("what", nargs=-1, metavar="[show NUMBER]")
@click.option(
    "--last", type=click.IntRange(1), metavar="N", help=f"The latest N.  [default: {SHOWN}; all with --since]"
)
@click.option("--since", type=UTC_TIME, help="Those that began at this time or later: ISO 8601, UTC.")
@click.option("--name", metavar="TEXT", help="Only targets with this in one of their names, or with this number.")
@click.option("--csv", "csv_number", type=click.IntRange(1), metavar="NUMBER", help="Print all samples of one as CSV.")
@global_options("config", "json", "verbose")
def command(
    what: tuple[str, ...], last: int | None, since: datetime | None, name: str | None, csv_number: int | None
) -> None:
    """List the passes that were followed, and how well the dish pointed; `show NUMBER` tells all of one.

    RMS and MAX are the angle on the sky between the target and the reported direction. 0.5 dB is the share of the time
    with less pointing loss than that, the age of the elements included. The
    target's direction includes the refraction that was set when it was followed; rise, highest point and set do not. A
    pass is also a CSV file: `birdcage paths`. `show` prints the level that was heard against elevation, too, and the
    files that hooks told of.
    """
    from birdcage.cli.log_report import tell_pass, tell_passes, values_of_pass, values_of_record, values_of_total
    from birdcage.cli.say import say, tell_json
    from birdcage.pursuit.pass_book import list_passes, read_files, read_remarks, read_samples, total_of
    from birdcage.sky.downlinks_read import load_downlinks
    from birdcage.sky.targets import Resolver

    journal = find_paths().journal
    if csv_number is not None:
        from birdcage.pursuit.pass_csv import whole_csv

        record = _one(journal, csv_number)
        click.echo(whole_csv(record.head, read_samples(journal, csv_number)), nl=False)
        return
    if what:
        number = _number(what)
        record = _one(journal, number)
        samples, remarks = read_samples(journal, number), read_remarks(journal, number)
        files = read_files(journal, number)
        if flags().json:
            tell_json(values_of_pass(record, samples, remarks, files))
        else:
            tell_pass(record, samples, remarks, files)
        return
    if last is None and since is None:
        last = SHOWN
    also = () if name is None else Resolver(None, load_downlinks(find_paths().downlinks_file)).numbers(name)
    records = list_passes(journal, last=last, since=since, name=name, also=also)
    total = total_of(records)
    if flags().json:
        tell_json({"passes": [values_of_record(each) for each in records], "total": values_of_total(total)})
    elif records:
        tell_passes(records, total)
    else:
        say("No passes logged yet." if name is None and since is None else "No logged pass matches.")


def _number(words: tuple[str, ...]) -> int:
    if len(words) != 2 or words[0] != "show" or not words[1].isdecimal():
        raise click.UsageError("Type `birdcage log`, or `birdcage log show NUMBER`.")
    return int(words[1])


def _one(journal: Path, number: int) -> PassRecord:
    """Return the pass of that number. ConfigError if there is none."""
    from birdcage.base.errors import ConfigError
    from birdcage.pursuit.pass_book import list_passes

    found = list_passes(journal, number=number) if number < 2**63 else []
    if not found:
        raise ConfigError(f"No such pass in the log: {number}. `birdcage log` lists them.")
    return found[0]
