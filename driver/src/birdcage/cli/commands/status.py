"""`birdcage status`."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.base.errors import BirdcageError
    from birdcage.station.control_client import Owner

    Found = tuple[dict[str, Any], BirdcageError | None]
    """What is known of a dish, and why that is nothing."""

BY = "birdcage status"
NAMING = ("flag", "environment")
"""Where a port that is named means one dish; a port in the settings says only which is usually meant."""


@click.command("status", epilog=exits.EPILOG)
@click.option("--quick", is_flag=True, help="Do not read its identity and settings, which takes some seconds.")
@global_options()
@click.pass_context
def command(context: click.Context, quick: bool) -> None:
    """Print the state of the dish, or of each where birdcage programs drive several.

    If another birdcage program has the port, that one is asked. --port, BIRDCAGE_PORT and --config mean that dish
    alone. With --json each dish is one line. What is not known is a dash, or null in JSON.
    """
    from birdcage.cli.say import say, tell, tell_json

    dish = wanted()
    found = _elsewhere(dish)
    if dish.port_given or not found or _has_owner(dish):
        found.insert(0, _usual(dish, quick=quick))
    for number, (status, _) in enumerate(found):
        status["wear"] = _wear(dish, status["firmware"], demo=bool(status["demo"]))
        if flags().json:
            tell_json(status)
            continue
        if len(found) > 1:
            tell(("\n" if number else "") + _name(status))
        for name, value in status.items():
            tell(f"{name:24} {_shown(value)}")
    troubles = [trouble for _, trouble in found if trouble is not None]
    for trouble in troubles:
        say(str(trouble))
    if troubles:
        context.exit(exits.code_of(troubles[0]))


def _usual(dish: Wanted, *, quick: bool) -> Found:
    """Return the state of the dish that is wanted, by the program that has its port, or else by itself."""
    from birdcage.base.errors import LinkError, NoReply
    from birdcage.cli.owners import ask_owner
    from birdcage.station.control_messages import TellStatus

    answer = ask_owner(dish, TellStatus(), BY)
    if answer is not None:
        port, told = answer
        return told | {"port": port}, None
    try:
        return _look(dish, quick=quick), None
    except (LinkError, NoReply) as error:
        return _unknown(dish), error


def _elsewhere(dish: Wanted) -> list[Found]:
    """Return the states of the dishes that birdcage programs drive at other ports; none where one dish was named."""
    from birdcage.cli.owners import owners_of, ring_all

    if dish.settings.sources.get("dish.port") in NAMING or flags().get("config") is not None:
        return []
    own = owners_of(replace(dish, port_given=True))
    others = [owner for owner in owners_of(replace(dish, port_given=False)) if owner not in own]
    return [found for found in ring_all(others, partial(_ask, dish)) if found is not None]


def _has_owner(dish: Wanted) -> bool:
    from birdcage.cli.owners import owners_of

    return bool(owners_of(replace(dish, port_given=True)))


def _ask(dish: Wanted, owner: Owner) -> Found | None:
    """Ask one program; None where it has ended."""
    from birdcage.base.errors import BirdcageError, NoReply
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner
    from birdcage.station.control_messages import TellStatus

    unknown = replace(dish, port=owner.port, firmware_given=False)
    try:
        told: dict[str, Any] = call_owner(owner, TellStatus(), BY)
    except OwnerGone:
        return None
    except NoAnswer as error:
        return _unknown(unknown), NoReply(f"{error}.")
    except BirdcageError as error:  # another version, say: that keeps no other dish from being shown
        return _unknown(unknown), error
    return told | {"port": owner.port}, None


def _name(status: dict[str, Any]) -> str:
    """Return what tells one dish from another: `NAME at /dev/ttyUSB1`."""
    from birdcage.station.known import model_of

    model = model_of(status["firmware"])
    return f"{'A dish' if model is None else model.name} at {status['port']}"


def _look(wanted: Wanted, *, quick: bool) -> dict[str, Any]:
    from birdcage.cli.dish import open_dish
    from birdcage.station.report import status_report

    with open_dish(wanted, survey=not quick) as dish:
        dish.come_up(15.0)
        if not quick:
            dish.survey()
        return dict(status_report(dish.state, dish.now))


def _unknown(dish: Wanted) -> dict[str, Any]:
    """Return the report of a dish that could not be reached: nothing is known of it."""
    from birdcage.station.report import status_report
    from birdcage.station.state import StationState

    named = {"firmware": dish.firmware} if dish.firmware_given else {}
    return dict(status_report(StationState(port=dish.port), 0.0)) | named


def _wear(dish: Wanted, firmware: str | None, *, demo: bool) -> dict[str, Any] | None:
    """Return what each axis has done so far, by its name; None if nothing was counted, or can't be read."""
    from birdcage.base.errors import StoreError
    from birdcage.base.wear import read_wear
    from birdcage.cli.say import say
    from birdcage.station.known import list_models
    from birdcage.station.wear import dish_key

    model = next((model for model in list_models() if model.firmware == firmware), None)
    if model is None:
        return None
    try:
        axes = read_wear(dish.paths.journal, dish_key(model.name, demo=demo))
    except StoreError as error:
        say(str(error))
        return None
    return {
        model.numbered[wear.axis].name: {
            "moves": wear.moves, "degrees": round(wear.degrees, 1), "reversals": wear.reversals,
            "since": wear.since.isoformat() if wear.since is not None else None,
        }
        for wear in axes
    } or None  # fmt: skip


def _shown(value: object) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return " ".join(map(str, value)) or "-"
    if isinstance(value, dict) and "clients" in value:
        return "; ".join([f"listens on {value['address']}", *map(_of_network, value["clients"])])
    if isinstance(value, dict) and "lines" in value:
        return f"{len(value['lines'])} lines, from {value['utc']} on; --json prints them"
    if isinstance(value, dict):
        return str(value["sentence"]) if "sentence" in value else "; ".join(map(_worn, value, value.values()))
    return str(value)


def _worn(axis: str, wear: dict[str, Any]) -> str:
    return f"{axis} {wear['degrees']:.0f}°, moves {wear['moves']}, reversals {wear['reversals']}"


def _of_network(client: dict[str, Any]) -> str:
    """Return a network client in words: `Gpredict (rotctld 1) 127.0.0.1:51234 has control`."""
    name = f"{client['program']} ({client['name']})" if client["program"] else client["name"]
    does = {"control": "has control", "ignored": "is ignored", "watches": "watches"}[client["role"]]
    follows = f", follows {client['follows']}" if client["follows"] else ""
    return f"{name} {client['address']} {does}{follows}"
