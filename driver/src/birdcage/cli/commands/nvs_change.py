"""`birdcage nvs set`, `save` and `restore`: what changes the dish's settings."""

from __future__ import annotations

from pathlib import Path

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among


@click.command("set", epilog=EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("pairs", metavar="ROW VALUE...", nargs=-1, required=True)
@click.option("--yes", is_flag=True, help="Agree to what it does in advance.")
@global_options()
def set_(pairs: tuple[str, ...], yes: bool) -> None:
    """Change rows in the dish's RAM: shows old and new values, and asks once.

    The whole table is backed up first. A power cycle takes the change back, unless `birdcage nvs save` keeps it.
    """
    from birdcage.base.errors import CommandRefused
    from birdcage.base.reason import Reason
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.settings_desk import open_desk
    from birdcage.cli.settings_words import HEAD, agree, row_cells, row_values, show_changes
    from birdcage.cli.table import tell_table
    from birdcage.rotator.setting_values import given_value, same_value

    no_options_among(pairs)
    wishes = _wishes(pairs)
    with open_desk(wanted(), "birdcage nvs set") as desk:
        table = desk.read()
        if missing := [index for index in wishes if index not in table.rows]:
            raise CommandRefused(
                f"The dish shows no row {missing[0]} that could be read. Nothing was written.", reason=Reason.NO_ROW
            )
        new = {index: given_value(table.rows[index], desk.own.known.get(index), text) for index, text in wishes.items()}
        new = {index: value for index, value in new.items() if not same_value(table.rows[index].current, value)}
        backup = None
        if new:
            show_changes(new, table, desk.own.known)
            agree("Change these rows in RAM?", yes)
            written = desk.write(new)
            table, backup = written.table, written.backup
    rows = [table.rows[index] for index in wishes]
    if flags().json:
        told = [row_values(each, desk.own.known) for each in rows]
        tell_json({"port": desk.port, "backup": backup, "changed": sorted(new), "rows": told})
    else:
        tell_table(HEAD, [row_cells(each, desk.own.known) for each in rows], "r lrrr")
    if not new:
        say("The dish has these values already. Nothing was written.")
        return
    say(f"Backup: {backup}")
    say("Changed in RAM only. `birdcage nvs save` keeps it, a power cycle takes it back.")


@click.command("save", epilog=EPILOG)
@click.option("--yes", is_flag=True, help="Agree to what it does in advance.")
@global_options()
def save(yes: bool) -> None:
    """Write all that the dish's RAM holds to its flash: shows what changes there, and asks once.

    It counts from the next power cycle on.
    """
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.settings_desk import open_desk
    from birdcage.cli.settings_words import COUNTS, agree, show_saves

    with open_desk(wanted(), "birdcage nvs save") as desk:
        table = desk.read()
        changes = [
            {"row": row.index, "name": row.name, "before": row.saved, "after": row.current} for row in table.unsaved
        ]
        saves = bool(changes) or not desk.own.tells_saved
        if saves:
            show_saves(table, table.to_save, desk.own.known)
            if not desk.own.tells_saved:
                click.echo("This dish does not tell what flash holds: all that its RAM holds is written.", err=True)
            agree("Save it?", yes)
            desk.save(table.to_save)
    if flags().json:
        tell_json({"port": desk.port, "saved": saves, "changes": changes, "verified": desk.own.tells_saved})
    if not saves:
        say("Flash holds all that RAM holds. Nothing was written.")
    elif desk.own.tells_saved:
        say(f"Saved, and read back. {COUNTS}")
    else:
        say(f"The dish answered the save, and does not tell what flash holds. {COUNTS} Then read the rows again.")


@click.command("restore", epilog=EPILOG)
@click.argument("file")
@click.option("--yes", is_flag=True, help="Agree to what it does in advance.")
@global_options()
def restore(file: str, yes: bool) -> None:
    """Put back the saved values of FILE: shows what differs, asks once, writes, saves, and reads back.

    FILE is a backup, or what `birdcage nvs dump` has kept of this kind of dish. Rows that could not be read are never
    written. It counts from the next power cycle on.
    """
    from birdcage.base.errors import CommandRefused
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.settings_desk import open_desk
    from birdcage.cli.settings_words import COUNTS, agree, show_changes, show_saves
    from birdcage.rotator.settings_compare import is_saved, lines_of_no_row, restoring, saved_after
    from birdcage.rotator.settings_file import read_settings_file

    dump = read_settings_file(Path(file))
    with open_desk(wanted(), "birdcage nvs restore") as desk:
        table, known = desk.read(), desk.own.known
        rows = desk.own.parse(dump.printed)
        new = restoring(dump, rows, table, desk.facts.firmware, known, file, demo=desk.demo)
        other = set(lines_of_no_row(dump.printed, rows)) ^ set(lines_of_no_row(table.printed, table.rows))
        for line in sorted(other):
            say(f"Not restored, as it could not be read: {line}")
        saves = bool(new) or not is_saved(rows, table) or not desk.own.tells_saved
        backup = None
        if saves:
            show_changes(new, table, known)
            show_saves(table, (index for index in table.to_save if index not in new), known)
            shown = saved_after(table, new)
            agree("Restore it, and save it to flash?", yes)
            if new:
                written = desk.write(new)
                backup = written.backup
                say(f"Backup: {backup}")
            table = desk.save(shown)
            if not is_saved(rows, table):
                raise CommandRefused(
                    f"The dish does not show all rows as {file} has them. Compare by `birdcage nvs diff`."
                )
    same = table.printed == dump.printed
    if flags().json:
        told = {"port": desk.port, "backup": backup, "changed": sorted(new), "saved": saves, "identical": same}
        tell_json(told)
    if not saves:
        say(f"The dish has all rows as {file} has them. Nothing was written.")
        return
    say(f"Restored and saved. {COUNTS}")
    say(f"The table is now that of {file}, byte for byte." if same else f"Compare by `birdcage nvs diff {file}`.")


def _wishes(pairs: tuple[str, ...]) -> dict[int, str]:
    """Return values by row. UsageError for what is no pairs."""
    if len(pairs) % 2:
        raise click.UsageError("Give a value for each row: ROW VALUE ROW VALUE.")
    wishes: dict[int, str] = {}
    for row, value in zip(pairs[::2], pairs[1::2], strict=True):
        if not (row.isascii() and row.isdecimal() and len(row) <= 6):
            raise click.UsageError(f"{row!r} is no number of a row.")
        if int(row) in wishes:
            raise click.UsageError(f"Row {int(row)} is given twice.")
        wishes[int(row)] = value
    return wishes
