"""What a caller and the program that has a port say to each other on the control channel: one JSON object a line.

    asked     {"v": 1, "token": "…", "by": "anna", "request": {"v": 1, "type": "Read", "features": ["rssi"]}}
    answered  {"v": 1, "ok": true, "result": …}
    refused   {"v": 1, "ok": false, "error": {"kind": "NoReply", "reason": "silent", "sentence": "…"}}

With `"events": true` in what is asked, the events follow an answer that is no refusal, each as `json_form` writes it.
The last line says why they end:

    ended     {"v": 1, "type": "EventsEnded", "why": "slow", "sentence": "…"}

A caller that asks for `Attach` stays for many requests (`attach_messages`).

The server is `control_server`, the caller's side `control_client`; `docs/architecture.md`, *The control channel*, tells
the whole.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, get_args

from birdcage.base.errors import BadMessage, BirdcageError
from birdcage.base.text import clean
from birdcage.rotator.feature import Reading
from birdcage.rotator.own_settings import SettingsTable, SettingsWritten
from birdcage.station.attach_messages import Attach, Attached, check_name
from birdcage.station.feature_report import error_values
from birdcage.station.json_form import VERSION, check_version, request_from_json, to_json
from birdcage.station.json_shapes import shape_of
from birdcage.station.json_values import Shape, shown
from birdcage.station.requests import (
    Read,
    ReadSettings,
    Release,
    SaveSettings,
    Set,
    Stop,
    Unwatch,
    Watch,
    WriteSettings,
)

LONGEST_LINE = 16_384
"""Bytes of what is asked: room for a save that names all rows of a dish's settings."""
LONG_S = 90.0
"""How much longer the answer waits where the dish may be kept for a minute: some readings, and its own settings."""
LONGEST_ANSWER = 4_000_000
"""Bytes of an answer or an event: far more than any has."""


@dataclass(frozen=True, slots=True)
class HoldDish:
    """Stop the dish and hold it, as `Stop` does, for a person who is about to work on it."""

    by: str


@dataclass(frozen=True, slots=True)
class TellStatus:
    """Tell the state of the dish, as `birdcage status --json` prints it. Moves and asks nothing."""


@dataclass(frozen=True, slots=True)
class ListFeatures:
    """Tell what the dish tells and lets be set, as `birdcage features --json` prints it. Asks the dish nothing."""


ControlRequest = (
    Stop | HoldDish | Release | TellStatus | ListFeatures | Read | Set | ReadSettings | WriteSettings | SaveSettings
    | Watch | Unwatch | Attach
)  # fmt: skip
FROM_OUTSIDE: Mapping[str, type] = {each.__name__: each for each in get_args(ControlRequest)}
"""What another program may ask in its first line, by name. None of them is a motion: who wants one attaches."""


RESULTS: Mapping[type, Shape] = {
    Read: shape_of(Mapping[str, Reading]), Set: shape_of(Reading), Attach: shape_of(Attached),
    ReadSettings: shape_of(SettingsTable), WriteSettings: shape_of(SettingsWritten),
    SaveSettings: shape_of(SettingsTable),
}  # fmt: skip
"""How the results of some look; those of the others are reports (`report`, `feature_report`), or null."""


class EndOfEvents(StrEnum):
    """Why a stream of events ended."""

    SLOW = "slow"
    """The caller did not read fast enough, and has missed some."""
    CLOSING = "closing"
    """The program that has the port is ending."""
    BAD_LINE = "bad line"
    """An attached caller has sent what is no line of this form."""


@dataclass(frozen=True, slots=True)
class EventsEnded:
    """The last line of a stream of events."""

    why: EndOfEvents
    sentence: str


ENDS = {
    each.why: each
    for each in (
        EventsEnded(
            EndOfEvents.SLOW, "Events came faster than they were read, so some are lost. Ask again to follow on."
        ),
        EventsEnded(EndOfEvents.CLOSING, "The program that has the port is ending."),
        EventsEnded(EndOfEvents.BAD_LINE, "That is no request with a number. Attach again: one object a line."),
    )
}


@dataclass(frozen=True, slots=True)
class ControlCall:
    """One line of a caller."""

    request: ControlRequest
    by: str
    """Who asks, for the log."""
    events: bool = False
    """Whether events are to follow the answer."""


def more_s(request: ControlRequest) -> float:
    """Return how much longer than others the answer to a request may take."""
    settings = isinstance(request, ReadSettings | WriteSettings | SaveSettings)
    return LONG_S if settings or (isinstance(request, Read) and request.agreed) else 0.0


def call_to_json(token: str, call: ControlCall) -> dict[str, object]:
    """Return what a caller sends."""
    told: dict[str, object] = {"v": VERSION, "token": token, "by": call.by, "request": to_json(call.request)}
    return told | {"events": True} if call.events else told


def call_from_json(told: Mapping[str, Any]) -> ControlCall:
    """Return what a caller asks, its token aside. BadMessage for all that is not in order, or not for callers."""
    check_version(told, "The line")
    if unknown := [key for key in told if key not in ("v", "token", "by", "request", "events")]:
        raise BadMessage(f"The line has no field {shown(unknown[0])}. It has v, token, by, request, events.")
    by, events = told.get("by", "another program"), told.get("events", False)
    if not isinstance(by, str) or not isinstance(events, bool):
        raise BadMessage('"by" is who asks, as text; "events" is true or false.')
    request = request_from_json(told.get("request"), FROM_OUTSIDE)
    if isinstance(request, Watch) and not events:
        raise BadMessage('A watch lasts as long as its caller listens. Ask with "events": true.')
    if isinstance(request, Attach):
        check_name(request)
    return ControlCall(request, clean(by), events)


def result_from_json(request: ControlRequest, told: object) -> Any:  # noqa: ANN401 - as `RESULTS` has it
    """Return what an answer holds: readings where `RESULTS` says so, else its JSON. BadMessage if it is neither."""
    shape = RESULTS.get(type(request))
    return told if shape is None else shape.take(told, "The result")


def done(request: ControlRequest, result: object) -> dict[str, object]:
    """Return the answer to what was done."""
    shape = RESULTS.get(type(request))
    return {"v": VERSION, "ok": True, "result": result if shape is None else shape.tell(result, "result")}


def refused(error: BirdcageError, told: object = None) -> dict[str, object]:
    """Return the answer to what was not done. `told` is the line, where an older birdcage may have written it."""
    old = isinstance(told, dict) and "do" in told and "v" not in told
    # That one shows this as it stands.
    return {"v": VERSION, "ok": False, "error": str(error) if old else error_values(error)}


def as_line(told: Mapping[str, object]) -> bytes:
    """Return an object as a line."""
    return json.dumps(told, allow_nan=False).encode() + b"\n"
