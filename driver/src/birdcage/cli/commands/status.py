"""`birdcage status`."""

from __future__ import annotations

from typing import Any

import click

from birdcage.cli import exits
from birdcage.cli.options import Wanted, flags, global_options, wanted


@click.command("status", epilog=exits.EPILOG)
@click.option("--quick", is_flag=True, help="Do not read its identity and settings, which takes some seconds.")
@global_options()
@click.pass_context
def command(context: click.Context, quick: bool) -> None:
    """Print the state of the dish.

    If another birdcage program has the port, that one is asked. What is not known is a dash, or null in JSON.
    """
    from birdcage.base.errors import LinkError, NoReply
    from birdcage.cli.owners import ask_owner
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.station.control_messages import TellStatus

    dish, trouble = wanted(), None
    answer = ask_owner(dish, TellStatus(), "birdcage status")
    if answer is not None:
        port, told = answer
        status = told | {"port": port}
    else:
        try:
            status = _look(dish, quick=quick)
        except (LinkError, NoReply) as error:
            trouble, status = error, _unknown(dish)
    status["wear"] = _wear(dish, status["firmware"], demo=bool(status["demo"]))
    if flags().json:
        tell_json(status)
    else:
        for name, value in status.items():
            tell(f"{name:24} {_shown(value)}")
    if trouble is not None:
        say(str(trouble))
        context.exit(exits.code_of(trouble))


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
