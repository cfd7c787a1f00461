"""`birdcage elements`: the catalogue of satellites."""

from __future__ import annotations

import click

from birdcage.cli.commands.elements_add import add, remove
from birdcage.cli.commands.elements_check import check
from birdcage.cli.commands.elements_list import list_, search
from birdcage.cli.commands.elements_notes import favourite, offset
from birdcage.cli.commands.elements_update import update
from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import global_options


@click.group("elements", epilog=DATA_EPILOG)
@global_options("config", "json", "verbose")
def command() -> None:
    """Keep the orbital elements of satellites: from files, from pasted text, or fetched when you say so."""


for each in (add, update, list_, search, check, favourite, offset, remove):
    command.add_command(each)
