"""`birdcage get`."""

from __future__ import annotations

import sys
from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted

PAGES = ("hardware", "motors", "receiver", "settings")


@click.command("get", epilog=exits.EPILOG)
@click.argument("names", metavar="[NAME]...", nargs=-1)
@click.option("--page", type=click.Choice(PAGES), help="Read all of a page.")
@click.option("--group", metavar="TEXT", help="Read all of a group, for example drivers.")
@click.option("--yes", is_flag=True, help="Agree in advance to what reading does.")
@global_options()
@click.pass_context
def command(context: click.Context, names: tuple[str, ...], page: str | None, group: str | None, yes: bool) -> None:
    """Read features of the dish; `birdcage features` lists their names, pages and groups.

    A page or group is read menu by menu, with as few lines as that takes. What reading itself changes needs your
    consent first; of a page it is left out without --yes. Nothing is read while the dish moves. If another birdcage
    program has the port, that one reads. What the dish does not tell is a dash, or null in JSON, and the exit status is
    1 then.
    """
    from birdcage.base.errors import ConfirmationNeeded
    from birdcage.cli.dish_features import read_features
    from birdcage.cli.say import tell, tell_json

    if page or group:
        if names:
            raise click.UsageError("Give names, or a page or group, not both.")
        told, lines = _read_page(page, group, yes)
    else:
        if not names:
            raise click.UsageError("Give the names of features, or --page or --group.")
        ids = tuple(dict.fromkeys(names))
        try:
            told = read_features(wanted(), ids, agreed=yes)
        except ConfirmationNeeded as needed:
            confirm(str(needed), yes, "Read it?")
            told = read_features(wanted(), ids, agreed=True)
        show = lines_of if len(ids) == 1 else _headed
        lines = [line for name, reading in told["readings"].items() for line in show(name, reading)]
    if flags().json:
        tell_json(told)
    else:
        for line in lines:
            tell(line)
    if None in told["readings"].values():
        context.exit(exits.NOT_DONE)


def _read_page(page: str | None, group: str | None, yes: bool) -> tuple[dict[str, Any], list[str]]:
    """Return what was read, and the lines that show it."""
    from birdcage.cli.dish_features import list_features, read_features
    from birdcage.cli.feature_pages import by_menu, on_page, page_lines
    from birdcage.cli.say import say

    dish = wanted()
    rows = on_page(list_features(dish)["features"], page, group)
    if left := [row["id"] for row in rows if row["read_hazard"] and not yes]:
        say(f"Not read, because reading changes something: {', '.join(left)}. With --yes they are read, too.")
        rows = [row for row in rows if row["id"] not in left]
    ids = tuple(name for part in by_menu(rows) for name in part)
    told: dict[str, Any] = {"port": dish.port, "readings": {}}
    if ids:
        told = read_features(dish, ids, agreed=yes)
    readings = {row["id"]: told["readings"][row["id"]] for row in rows}
    shown = {name: [f"  {line}" for line in _headed(name, reading)] for name, reading in readings.items()}
    return told | {"readings": readings}, page_lines(rows, shown)


def _headed(name: str, reading: dict[str, Any] | None) -> list[str]:
    """Return a reading that stands among others: text of several lines is indented below its name."""
    lines = lines_of(name, reading)
    if reading is not None and isinstance(reading["value"], list):
        return [name, *(f"  {line}" for line in lines)]
    return lines


def confirm(hazard: str, yes: bool, question: str) -> None:
    """Say a consequence, and ask whether to go on. UsageError where no terminal can be asked; Abort for a no."""
    click.echo(hazard, err=True)
    if yes:
        return
    if not sys.stdin.isatty():
        raise click.UsageError("Give --yes to do it.")
    click.confirm(question, abort=True, err=True)


def lines_of(name: str, reading: dict[str, Any] | None) -> list[str]:
    """Return a reading for a person: name, value and unit; text of several lines as it is."""
    if reading is None:
        return [f"{name:24} -"]
    value = reading["value"]
    if isinstance(value, list):
        return value
    return [f"{name:24} {value_text(value)} {reading['unit'] or ''}".rstrip()]


def value_text(value: bool | float | str) -> str:
    """Return a value as it is shown, and typed to set it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
