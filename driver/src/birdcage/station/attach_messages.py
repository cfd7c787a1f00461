r"""What a program that is attached to a station and the station's program say to each other: one JSON object a line.

    asked      {"v": 1, "token": "…", "by": "…", "request": {"v": 1, "type": "Attach", "name": "anna (pts/3)"}}
    answered   {"v": 1, "ok": true, "result": {"name": "anna (pts/3)", "host": "anna (pts/1)", "at": 3182.3, …}}

From then on lines go both ways, until either side hangs up. The caller's are requests, each with a number of its own:

    asked      {"v": 1, "id": 7, "request": {"v": 1, "type": "Goto", "az_deg": 180.0, …}}
    answered   {"v": 1, "id": 7, "ok": true, "result": …}          in any order: a go-to at its arrival
    refused    {"v": 1, "id": 7, "ok": false, "error": {"kind": "Held", "reason": "held", "sentence": "…"}}

Between the answers stand the state, whole at first and then what has changed of it, and the events, in the order in
which all of that came to be. A state is never older than the event or the answer behind it:

    told       {"v": 1, "type": "StateTold", "state": {"link": …, "position": …, …}}
    told       {"v": 1, "type": "StateChanged", "changes": {"position": …}}
    told       {"v": 1, "type": "PositionRead", …}

A caller that asks for `HearWire` is told what passes on the wire, too, behind all else, as the transcript has it and
whether a pursuit has sent it. `missed` pieces before these were dropped, as they were not read fast enough:

    asked      {"v": 1, "id": 8, "request": {"v": 1, "type": "HearWire", "on": true}}
    told       {"v": 1, "type": "WirePassed", "missed": 0, "pieces": [["2026-03-20T12:00:00.123Z > a\\r", false], …]}

One that joins a service of the program (`services`) gives it orders, and is told its newest news: null while there is
no such service. Plans are told whole before the first state, event or news that has their outline (`plan_form`):

    asked      {"v": 1, "id": 9, "request": {"v": 1, "type": "JoinService", "service": "pursuit"}}
    asked      {"v": 1, "id": 10, "request": {"v": 1, "type": "AskService", "service": "pursuit", "order": …}}
    told       {"v": 1, "type": "ServiceTold", "service": "pursuit", "news": …}

One that serves clients over the network shows them in the station with `ShowNetwork`, until it hangs up.

The last line is an `EventsEnded`, which says why. `attached_caller` serves, `attached` asks.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import Any, get_args

from birdcage.base.errors import BadMessage, BirdcageError
from birdcage.base.held import user_name
from birdcage.base.text import clean
from birdcage.rotator.feature import Reading
from birdcage.rotator.own_settings import SettingsTable, SettingsWritten
from birdcage.station import requests as ask
from birdcage.station.feature_report import error_values
from birdcage.station.json_form import VERSION, check_version, request_from_json, request_types
from birdcage.station.json_shapes import AnyJson, FieldsShape, shape_of
from birdcage.station.json_values import MOST, Shape, shown
from birdcage.station.network_state import NetworkState
from birdcage.station.raw import CONSOLE, MenuCommand, RawReply, TranscriptEntry, format_line, parse_line
from birdcage.station.state import Pointing, StationState

YOU = "you"
"""How a face calls the person at its own terminal. In a station that is the person at the station's own program."""
LONGEST_NAME = 60
LONGEST_ASKED = 1_000_000
"""Bytes of what an attached program asks: room for what all clients of a server have said."""
NAMED = frozenset({"holder", "by", "previous", "next_holder", "watcher"})
"""Fields of requests, events and the state that name somebody."""
STATE_TOLD, STATE_CHANGED, WIRE_PASSED, SERVICE_TOLD = "StateTold", "StateChanged", "WirePassed", "ServiceTold"


@dataclass(frozen=True, slots=True)
class Attach:
    """Stay for many requests, and be told the state and all events. The answer is an `Attached`."""

    name: str
    """How the caller wants to be called in the station, as a holder of control: `anna (pts/3)`."""


@dataclass(frozen=True, slots=True)
class Attached:
    """What a station says to a program that it has attached."""

    name: str
    """How this caller is called in the station: as it asked, with a number behind it if that name was taken."""
    host: str
    """How the person at the station's own program is called, who is `you` there."""
    at: float
    """Monotonic seconds of the station now: all its times go by that clock."""
    utc: datetime
    asked: str
    """The port as the station's user named it."""
    program: str
    """What the station's program is: `birdcage station run`."""


@dataclass(frozen=True, slots=True)
class HearWire:
    """Tell what passes on the wire from now on (`WirePassed`), or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class JoinService:
    """Tell the news of a service of this program from now on (`ServiceTold`), and take orders for it."""

    service: str


@dataclass(frozen=True, slots=True)
class AskService:
    """Give a service that was joined an order. The answer says whether it was taken, and not what came of it."""

    service: str
    order: AnyJson


@dataclass(frozen=True, slots=True)
class ShowNetwork:
    """Show the server of this caller, and its clients, as `StationState.network`; null, or hanging up, ends that."""

    network: NetworkState | None


BesideRequest = HearWire | JoinService | AskService | ShowNetwork
"""What an attached program asks for beside the requests of the station."""


@dataclass(frozen=True, slots=True)
class WirePiece:
    """What passed on the wire at once, or a remark."""

    entry: TranscriptEntry
    steered: bool
    """Whether a pursuit has sent it."""


def name_here() -> str:
    """Return how the person at this program is called in other programs: `anna (pts/3)`; `anna (process 4711)`."""
    try:
        where = os.ttyname(0).removeprefix("/dev/")
    except (OSError, AttributeError):
        where = f"process {os.getpid()}"
    return clean(f"{user_name()} ({where})")[:LONGEST_NAME]


def check_name(attach: Attach) -> None:
    """Raise BadMessage for a name that no attached program may have."""
    if not attach.name.strip() or len(attach.name) > LONGEST_NAME or attach.name in (YOU, CONSOLE):
        raise BadMessage(
            f"{shown(attach.name)} can't be a name here. Give your own, of 1 to {LONGEST_NAME} characters."
        )


def renamed(told: Any, names: Mapping[str, str]) -> Any:  # noqa: ANN401 - any JSON
    """Return JSON in which who is named in it (`NAMED`) goes by another name."""
    if isinstance(told, list):
        return [renamed(each, names) for each in told]
    if not isinstance(told, dict):
        return told
    return {
        key: names.get(each, each) if key in NAMED and isinstance(each, str) else renamed(each, names)
        for key, each in told.items()
    }


@cache
def result_shapes() -> Mapping[type, Shape]:
    """Return how the results of requests look; those that are missing have none, which is null."""
    from birdcage.detection.probe import BaudFinding

    kinds: Mapping[type, Any] = {
        **dict.fromkeys((ask.Goto, ask.Follow, ask.Jog, ask.TurnSkew, ask.Stow, ask.Sync), Pointing | None),
        ask.BeginTask: int, ask.ResumeTask: int, ask.SetSpeed: float, ask.Read: Mapping[str, Reading],
        ask.Set: Reading, ask.Raw: RawReply, ask.ListCommands: tuple[MenuCommand, ...],
        ask.ProbePort: tuple[BaudFinding, ...], ask.SetSearch: Path | None,
        ask.ReadSettings: SettingsTable, ask.WriteSettings: SettingsWritten, ask.SaveSettings: SettingsTable,
    }  # fmt: skip
    return {kind: shape_of(result) for kind, result in kinds.items()}


def asked_from_json(told: object) -> tuple[int, ask.Request | BesideRequest | BadMessage]:
    """Return the number of a request of an attached caller, and the request, or what is wrong with it.

    BadMessage for a line without a number: no answer to it could be told from others.
    """
    if not isinstance(told, dict):
        raise BadMessage("The line holds no object of JSON.")
    number = told.get("id")
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number <= MOST:
        raise BadMessage(f'"id" is {shown(number)}. Give each request a whole number of its own, from 0 to 2^53.')
    try:
        check_version(told, "The line")
        if unknown := [key for key in told if key not in ("v", "id", "request")]:
            raise BadMessage(f"The line has no field {shown(unknown[0])}. It has v, id, request.")
        request: ask.Request | BesideRequest = request_from_json(told.get("request"), _askable())
        for field in ("holder", "by", "watcher"):
            if getattr(request, field, None) == YOU:
                raise BadMessage(f'{type(request).__name__}.{field} is "{YOU}". Give the name that you have here.')
    except BadMessage as error:
        return number, error
    return number, request


@cache
def _askable() -> Mapping[str, type]:
    return {**request_types(), **{each.__name__: each for each in get_args(BesideRequest)}}


def told_by_service(service: str, news: object) -> dict[str, object]:
    """Return news of a service as a line; None: there is no such service now."""
    return {"v": VERSION, "type": SERVICE_TOLD, "service": service, "news": news}


def news_from_json(told: Mapping[str, Any]) -> tuple[str, object]:
    """Return whose news a line tells, and what they are, as JSON. BadMessage for all else."""
    check_version(told, "The news")
    service: str = shape_of(str).take(told.get("service"), "service")
    return service, told.get("news")


def wire_to_json(pieces: Sequence[WirePiece], missed: int) -> dict[str, object]:
    """Return what passed on the wire as a line."""
    told = [[format_line(piece.entry), piece.steered] for piece in pieces]
    return {"v": VERSION, "type": WIRE_PASSED, "missed": missed, "pieces": told}


def wire_from_json(told: Mapping[str, Any]) -> tuple[list[WirePiece], int]:
    """Return what passed on the wire, and how many pieces before it were dropped. BadMessage for all else."""
    check_version(told, "The wire")
    missed: int = shape_of(int).take(told.get("missed"), "missed")
    found = []
    for piece in shape_of(tuple[tuple[str, bool], ...]).take(told.get("pieces"), "pieces"):
        try:
            found.append(WirePiece(parse_line(piece[0]), piece[1]))
        except ValueError as error:
            raise BadMessage(f"The wire holds {error}.") from None
    return found, missed


def answer_to_json(number: int | None, request: type, result: object) -> dict[str, object]:
    """Return the answer to a request; `result` may be the error that it ended with."""
    if not isinstance(result, BirdcageError):
        shape = result_shapes().get(request)
        try:
            told = None if shape is None else shape.tell(result, "result")
        except BadMessage as error:
            result = error
        else:
            return {"v": VERSION, "id": number, "ok": True, "result": told}
    return {"v": VERSION, "id": number, "ok": False, "error": error_values(result)}


def result_from_answer(request: type, told: object) -> object:
    """Return the result in an answer. BadMessage where it is none."""
    shape = result_shapes().get(request)
    return None if shape is None else shape.take(told, "The result")


@cache
def state_shape() -> FieldsShape:
    """Return the shape of the state."""
    return FieldsShape(StationState)


def state_to_json(state: StationState, before: StationState | None) -> dict[str, object] | None:
    """Return the state as a line, or what of it differs from `before`; None if nothing does.

    A field with a value that JSON can't hold is left out, and keeps the value that was told last.
    """
    told = {}
    for field in state_shape().fields:
        value = getattr(state, field.name)
        if before is not None:
            old = getattr(before, field.name)
            if value is old or value == old:
                continue
        try:
            told[field.name] = field.shape.tell(value, field.name)
        except BadMessage:
            continue
    if before is None:
        return {"v": VERSION, "type": STATE_TOLD, "state": told}
    return {"v": VERSION, "type": STATE_CHANGED, "changes": told} if told else None


def state_from_json(told: Mapping[str, Any], before: StationState) -> StationState:
    """Return the state that a line tells: whole, or changes of the one `before`. BadMessage for all else."""
    check_version(told, "The state")
    if told["type"] == STATE_TOLD:
        state: StationState = state_shape().take(told.get("state"), "The state")
        return state
    changes, shapes = told.get("changes"), {field.name: field.shape for field in state_shape().fields}
    if not isinstance(changes, dict):
        raise BadMessage(f"The changes of the state are {shown(changes)}. Give an object.")
    if unknown := [key for key in changes if key not in shapes]:
        raise BadMessage(f"The state has no field {shown(unknown[0])}.")
    return replace(before, **{name: shapes[name].take(value, name) for name, value in changes.items()})
