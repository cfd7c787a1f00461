"""The JSON form of requests and events: what the control channel, `birdcage events`, tools and tests write and read.

    {"v": 1, "type": "Goto", "az_deg": 180.0, "el_deg": 45.0, "holder": "you", "clamp": false, "take_over": false}

`v` is the version of the form, `type` the name of the class, the rest its fields under their own names. `json_shapes`
tells how each type looks; `docs/events.md` lists them all. A request or an event that is added needs nothing here.
"""

from __future__ import annotations

import inspect
import json
from collections.abc import Mapping
from functools import cache
from typing import Any, get_args

from birdcage.base.errors import BadMessage
from birdcage.station import events
from birdcage.station.events import Event
from birdcage.station.json_shapes import FieldsShape
from birdcage.station.json_values import shown
from birdcage.station.requests import ApplySettings, Pursue, Request

VERSION = 1
"""Of the form. A program reads its own version and no later one."""
STAYS_INSIDE: Mapping[type, str] = {
    Pursue: "A plan is made by the program that has the port, and stays there.",
    ApplySettings: "Settings come from birdcage.toml, which every program reads for itself.",
}
"""Requests that have no JSON form, and why."""


@cache
def request_types() -> dict[str, type]:
    """Return the requests that have a JSON form, by name."""
    return {each.__name__: each for each in get_args(Request) if each not in STAYS_INSIDE}


@cache
def event_types() -> dict[str, type]:
    """Return all events by name."""
    found = (each for _, each in inspect.getmembers(events, inspect.isclass) if issubclass(each, Event))
    return {each.__name__: each for each in found if each is not Event}


@cache
def fields_of(kind: type) -> FieldsShape:
    """Return the fields of a request or event, and how each looks in JSON."""
    return FieldsShape(kind)


def to_json(message: object) -> dict[str, object]:
    """Return a request or an event as an object of JSON.

    BadMessage for one that stays inside the program, and where a field holds what JSON can't: NaN, infinity.
    """
    kind: Any = type(message)
    if kind in STAYS_INSIDE:
        raise BadMessage(f"{kind.__name__} has no JSON form. {STAYS_INSIDE[kind]}")
    return {"v": VERSION, "type": kind.__name__, **fields_of(kind).tell(message, kind.__name__)}


def request_from_json(told: object, among: Mapping[str, type] | None = None) -> Any:  # noqa: ANN401 - of `among`
    """Return the request that an object of JSON is: one `among` these by name, or any. BadMessage for all else."""
    return _from_json(told, request_types() if among is None else among, "request")


def event_from_json(told: object) -> Event:
    """Return the event that an object of JSON is. BadMessage for all else.

    The plan of a pursuit that comes back is a `PlanOutline`.
    """
    event: Event = _from_json(told, event_types(), "event")
    return event


def parse(line: bytes | str) -> object:
    """Return what a line of JSON holds. BadMessage for any other line, for NaN and infinity, and for too deep nests."""
    try:
        return json.loads(line, parse_constant=_refuse_constant)
    except BadMessage:
        raise
    except (ValueError, RecursionError):
        raise BadMessage("That is no line of JSON. Send one object a line, in UTF-8.") from None


def check_version(told: Mapping[Any, Any], what: str) -> None:
    """Raise BadMessage unless an object is in a version that this program reads."""
    version = told.get("v")
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise BadMessage(f'{what} says no version. Give "v": {VERSION}.')
    if version > VERSION:
        raise BadMessage(
            f"{what} is in version {shown(version)}, and this birdcage reads version {VERSION}. Update it, or use the "
            "same birdcage in both programs."
        )


def _from_json(told: object, among: Mapping[str, type], what: str) -> Any:  # noqa: ANN401 - of `among`
    if not isinstance(told, dict):
        raise BadMessage(f"The {what} is {shown(told)}. Give an object.")
    check_version(told, f"The {what}")
    name = told.get("type")
    if isinstance(name, str) and (inside := {each.__name__: why for each, why in STAYS_INSIDE.items()}.get(name)):
        raise BadMessage(f"{name} can't come from another program. {inside}")
    kind = among.get(name) if isinstance(name, str) else None
    if kind is None:
        raise BadMessage(f"{shown(name)} is no {what} here. There are {', '.join(among)}.")
    given = {key: each for key, each in told.items() if key not in ("v", "type")}
    return fields_of(kind).take(given, kind.__name__)


def _refuse_constant(name: str) -> None:
    raise BadMessage(f"JSON has no {name}. Give a number, or null for what is not known.")
