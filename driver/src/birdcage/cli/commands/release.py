"""`birdcage release`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted


@click.command("release", epilog=exits.EPILOG)
@global_options()
@click.pass_context
def command(context: click.Context) -> None:
    """Let programs move the dish again, and say who held it since when.

    Nothing moves by that itself. A program that waits may move the dish next: it is named. Without a port, the one
    dish that is held is released.
    """
    from birdcage.base.held import user_name
    from birdcage.cli.owners import ring_owners
    from birdcage.cli.say import tell, tell_json
    from birdcage.station.requests import Release

    dish, by = _by_name(wanted()), f"{user_name()} (birdcage release)"
    told = ring_owners(dish, Release(by), by) or [_release(dish)]
    for each in told:
        if flags().json:
            tell_json(each)
            continue
        words = f"{each['port']}: the dish is not held." if each["was"] is None else f"{each['was']} Released."
        if each["was"] is not None and each["held"]:
            words = f"{each['was']} Not released."
        if each["next_holder"]:
            words += f" {each['next_holder']} waits to move it."
        tell(" ".join(filter(None, (words, each["trouble"]))))
    if any(each["held"] for each in told):
        context.exit(exits.NOT_DONE)


def _by_name(dish: Wanted) -> Wanted:
    """Return the one dish that is meant: without a port, the one that is held, else the one that a program drives.

    ConfigError, and nothing is released, where there are several.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.cli.owners import owners_of
    from birdcage.station.holding import list_held

    if dish.port_given:
        return dish
    held = list_held(dish.paths)
    if len(held) > 1:
        ports = ", ".join(each.note.port or str(each.file.path) for each in held)
        raise ConfigError(f"{len(held)} dishes are held: {ports}. Name one with --port.")
    if held and held[0].note.port:
        return replace(dish, port=held[0].note.port, port_given=True)
    owners = owners_of(dish)
    if len(owners) > 1:
        ports = ", ".join(owner.port for owner in owners)
        raise ConfigError(f"{len(owners)} dishes are driven: {ports}. Name one with --port. Nothing was released.")
    return dish


def _release(dish: Wanted) -> dict[str, Any]:
    """Release a dish that no program of ours drives now."""
    from birdcage.station.holding import find_held

    held = find_held(dish.paths, dish.port)
    if held is None:
        return {"port": dish.port, "held": False, "was": None, "next_holder": None, "trouble": None}
    held.release()
    port = held.note.port or dish.port
    return {"port": port, "held": False, "was": held.note.sentence, "next_holder": None, "trouble": None}
