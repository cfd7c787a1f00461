"""`birdcage nvs dump`, `get` and `diff`: what only reads."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import EPILOG, NOT_DONE
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.rotator.own_settings import SettingRow
    from birdcage.rotator.settings_file import SettingsDump


@click.command("dump", epilog=EPILOG)
@click.argument("file", required=False)
@global_options()
def dump(file: str | None) -> None:
    """Print the whole table as the dish prints it, or keep it in FILE.

    FILE must not exist yet. Lines with # before the table say of which dish it is, and when. `birdcage nvs restore`
    takes such a file.
    """
    from datetime import UTC, datetime

    from birdcage.cli.say import iso, say, tell, tell_json
    from birdcage.cli.settings_desk import open_desk
    from birdcage.cli.settings_words import row_values, unfinished_values
    from birdcage.rotator.settings_file import settings_text

    if file is not None:
        _refuse_to_replace(file)
    with open_desk(wanted(), "birdcage nvs dump") as desk:
        table, read = desk.read(), datetime.now(UTC)
    text = settings_text(desk.facts.name, desk.facts.firmware, read, table.printed, demo=desk.demo)
    if file is not None:
        _keep(file, text)
        say(f"{len(table.rows)} rows are kept in {file}.")
    if flags().json:
        tell_json({
            "port": desk.port, "machine": desk.facts.name, "firmware": desk.facts.firmware, "read": iso(read),
            "demo": desk.demo, "rows": [row_values(each, desk.own.known) for each in table.rows.values()],
            "printed": list(table.printed), "unfinished": unfinished_values(table.unfinished),
        })  # fmt: skip
    elif file is None:
        for line in text.splitlines():
            tell(line)


@click.command("get", epilog=EPILOG)
@click.argument("rows", metavar="ROW...", nargs=-1, required=True, type=click.IntRange(0, 999_999))
@global_options()
@click.pass_context
def get(context: click.Context, rows: tuple[int, ...]) -> None:
    """Print rows by their numbers, with what is known of them. The exit status is 1 where the dish lacks one."""
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.settings_desk import open_desk
    from birdcage.cli.settings_words import HEAD, row_cells, row_values, unfinished_values
    from birdcage.cli.table import tell_table
    from birdcage.rotator.setting_values import danger_of

    with open_desk(wanted(), "birdcage nvs get") as desk:
        table = desk.read()
    indices = tuple(dict.fromkeys(rows))
    found = [table.rows[index] for index in indices if index in table.rows]
    if flags().json:
        told = {str(index): None for index in indices} | {
            str(each.index): row_values(each, desk.own.known) for each in found
        }
        tell_json({"port": desk.port, "rows": told, "unfinished": unfinished_values(table.unfinished)})
    elif found:
        tell_table(HEAD, [row_cells(each, desk.own.known) for each in found], "r lrrr")
        for each in found:
            known = desk.own.known.get(each.index)
            words = " ".join(filter(None, (known.note if known else "", danger_of(known))))
            if words:
                tell(f"Row {each.index}: {words}")
    for index in indices:
        if index not in table.rows:
            say(f"The dish shows no row {index} that could be read.")
    if len(found) < len(indices):
        context.exit(NOT_DONE)


@click.command("diff", epilog=EPILOG)
@click.argument("first", metavar="A")
@click.argument("second", metavar="[B]", required=False)
@global_options()
def diff(first: str, second: str | None) -> None:
    """Compare two files of settings, or the file A with the dish: each row that differs, with both values."""
    from birdcage.base.errors import CommandRefused
    from birdcage.base.reason import Reason
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.settings_desk import open_desk, own_settings_of
    from birdcage.cli.settings_words import difference_cells
    from birdcage.cli.table import tell_table
    from birdcage.rotator.settings_compare import differences, lines_of_no_row
    from birdcage.rotator.settings_file import read_settings_file

    one = read_settings_file(Path(first))
    if second is None:
        with open_desk(wanted(), "birdcage nvs diff") as desk:
            table = desk.read()
        firmware, printed, other = desk.facts.firmware, table.printed, table.rows
        rows = desk.own.parse(one.printed)
    else:
        two = read_settings_file(Path(second))
        firmware, printed = two.firmware, two.printed
        own = own_settings_of(one.firmware or two.firmware or wanted().firmware)
        if own is None:
            raise CommandRefused(f"{first} does not say of which dish it is. Name it with --firmware.")
        rows, other = own.parse(one.printed), own.parse(two.printed)
    if one.firmware and firmware and one.firmware != firmware:
        raise CommandRefused(
            f"{first} is of firmware {one.firmware}, the other table of {firmware}: their rows mean different things.",
            reason=Reason.BAD_PARAMETER,
        )
    _need_rows(first, one, rows)
    found = differences(rows, other)
    texts = set(lines_of_no_row(one.printed, rows)) ^ set(lines_of_no_row(printed, other))
    if flags().json:
        told = [{"row": each.index, "name": each.name, "a": each.first, "b": each.second} for each in found]
        tell_json({"differences": told, "lines": sorted(texts)})
        return
    if found:
        tell_table(("row", "name", "A", "B" if second else "the dish"), list(map(difference_cells, found)), "r lrr")
    for line in sorted(texts):
        tell(f"Only in one of them: {line}")
    if not found and not texts:
        say("No row differs.")


def _need_rows(file: str, dump: SettingsDump, rows: Mapping[int, SettingRow]) -> None:
    from birdcage.base.errors import StoreError
    from birdcage.base.reason import Reason

    if not rows:
        raise StoreError(f"None of the {len(dump.printed)} lines of {file} is a setting.", reason=Reason.DAMAGED)


def _refuse_to_replace(file: str) -> None:
    from birdcage.base.errors import StoreError

    if Path(file).exists():
        raise StoreError(f"{file} exists, and may be your only copy of other settings. Name another file.")


def _keep(file: str, text: str) -> None:
    from birdcage.base.errors import StoreError
    from birdcage.base.paths import write_aside_and_rename

    try:
        write_aside_and_rename(Path(file), text.encode())
    except OSError as error:
        raise StoreError(f"{file} can't be written: {error.strerror}.") from error
