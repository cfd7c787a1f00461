"""`birdcage nvs`."""

from __future__ import annotations

import click

from birdcage.cli.commands.nvs_change import restore, save, set_
from birdcage.cli.commands.nvs_read import diff, dump, get
from birdcage.cli.exits import EPILOG


@click.group("nvs", epilog=EPILOG)
def command() -> None:
    """Read and change the settings that the dish keeps in its own memory.

    A change goes to RAM, where a power cycle takes it back. `save` writes RAM to flash, and that counts from the next
    power cycle on. Nothing is read or written while the dish moves.
    """


for _each in (dump, get, set_, save, diff, restore):
    command.add_command(_each)
