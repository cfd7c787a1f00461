"""`birdcage get`."""

from __future__ import annotations

import sys
from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted


@click.command("get", epilog=exits.EPILOG)
@click.argument("names", metavar="NAME...", nargs=-1, required=True)
@click.option("--yes", is_flag=True, help="Agree in advance to what reading does.")
@global_options()
@click.pass_context
def command(context: click.Context, names: tuple[str, ...], yes: bool) -> None:
    """Read features of the dish; `birdcage features` lists their names.

    What reading itself changes needs your consent first. Nothing is read while the dish moves. If another birdcage
    program has the port, that one reads. What the dish does not tell is a dash, or null in JSON, and the exit status is
    1 then.
    """
    from birdcage.base.errors import ConfirmationNeeded
    from birdcage.cli.dish_features import read_features
    from birdcage.cli.say import tell, tell_json

    ids = tuple(dict.fromkeys(names))
    try:
        told = read_features(wanted(), ids, agreed=yes)
    except ConfirmationNeeded as needed:
        confirm(str(needed), yes, "Read it?")
        told = read_features(wanted(), ids, agreed=True)
    if flags().json:
        tell_json(told)
    else:
        for name, reading in told["readings"].items():
            for line in lines_of(name, reading):
                tell(line)
    if None in told["readings"].values():
        context.exit(exits.NOT_DONE)


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
    if isinstance(value, bool):
        shown = "on" if value else "off"
    else:
        shown = f"{value:.6g}" if isinstance(value, float) else str(value)
    return [f"{name:24} {shown} {reading['unit'] or ''}".rstrip()]
