"""Asks the process that owns a port. The owner's side is `control_server`."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from birdcage.base.errors import BadMessage, CommandRefused
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file
from birdcage.station.attach_messages import Attach, Attached
from birdcage.station.control_messages import (
    LONGEST_ANSWER,
    LONGEST_LINE,
    ControlCall,
    ControlRequest,
    EventsEnded,
    as_line,
    call_to_json,
    more_s,
    result_from_json,
)
from birdcage.station.feature_report import error_of
from birdcage.station.json_form import check_version
from birdcage.station.json_lines import LineReader

CONNECT_S = 1.0
ANSWER_S = 10.0
"""Longer than the owner waits for the dish to confirm a STOP."""


@dataclass(frozen=True, slots=True)
class Owner:
    """A process that has a port open, as it announced itself."""

    pid: int
    port: str
    asked: str
    """The port as its user named it: another name, or where the adapter was before."""
    tcp_port: int
    token: str
    file: Path


class OwnerGone(Exception):
    """No process answers: it never listened, or it has ended."""


class NoAnswer(Exception):
    """The process lives, and does not answer."""


def owners_folder(paths: Paths) -> Path:
    """Return the folder in which processes announce that they own a port."""
    return paths.state / "owners"


def owner_file(folder: Path, port: str) -> Path:
    """Return the file in which the owner of `port` announces itself; all names of one device lead to one file."""
    real = port if "://" in port else os.path.realpath(port)
    # The name is for people; what tells one port from another is the sum.
    readable = re.sub(r"\W+", "-", real).strip("-")[-40:]
    return folder / f"{readable}-{hashlib.sha256(real.encode()).hexdigest()[:8]}.json"


def find_owner(folder: Path, port: str) -> Owner | None:
    """Return who announced to own `port`; whether it still lives shows when it is called.

    A port that is gone is looked for under the name that its owner was given.
    """
    owner = _read(owner_file(folder, port))
    if owner is None and not os.path.exists(port):  # noqa: PTH110 - a port is a name, not always a path
        owner = next((each for each in find_owners(folder) if port in (each.asked, each.port)), None)
    return owner


def find_owners(folder: Path) -> list[Owner]:
    """Return all that announced themselves."""
    found = (_read(path) for path in sorted(folder.glob("*.json")))
    return [owner for owner in found if owner is not None]


def call_owner(owner: Owner, request: ControlRequest, by: str) -> Any:  # noqa: ANN401 - as `control_messages.RESULTS`
    """Have the owner do what is asked, and return what it tells; `by` says who asks.

    OwnerGone when it has ended, or ends before it answers; a file left behind by it is then removed. NoAnswer when
    it lives and keeps silent. CommandRefused when it does not know what is asked, or that is too long. Any other
    BirdcageError is the owner's own.
    """
    with _called(owner, ControlCall(request, by)) as lines:
        return _result(owner, request, _answer(owner, lines, ANSWER_S + more_s(request)))


@contextlib.contextmanager
def follow_owner(owner: Owner, request: ControlRequest, by: str) -> Iterator[Iterator[dict[str, Any]]]:
    """Ask the owner, and give every event that it tells from then on as JSON, and then its last line, `EventsEnded`.

    Raises what `call_owner` does; each event raises OwnerGone where the last line is missing.
    """
    with _called(owner, ControlCall(request, by, events=True)) as lines:
        _result(owner, request, _answer(owner, lines))
        yield _events(owner, lines)


def _events(owner: Owner, lines: LineReader) -> Iterator[dict[str, Any]]:
    told: dict[str, Any] = {}
    while told.get("type") != EventsEnded.__name__:
        try:
            told = _next(lines, None)
        except (OSError, ValueError):
            # It may live, and have dropped a caller that was too slow: its file stays.
            raise OwnerGone(f"process {owner.pid} has ended, or hung up") from None
        yield told


def attach_to(owner: Owner, name: str, by: str) -> tuple[socket.socket, bytes, Attached]:
    """Attach to the owner; return the line, what was read of it already, and what it says (`attach_messages`).

    The line is then the caller's to close. Raises what `call_owner` does.
    """
    request = Attach(name)
    with contextlib.ExitStack() as stack:
        line = stack.enter_context(_connected(owner, ControlCall(request, by)))
        lines = LineReader(line)
        attached: Attached = _result(owner, request, _answer(owner, lines))
        stack.pop_all()
    return line, lines.ahead, attached


@contextlib.contextmanager
def _called(owner: Owner, call: ControlCall) -> Iterator[LineReader]:
    """Send what is asked, and give the lines that come back."""
    with _connected(owner, call) as line:
        yield LineReader(line)


def _connected(owner: Owner, call: ControlCall) -> socket.socket:
    """Connect, and send what is asked."""
    asked = as_line(call_to_json(owner.token, call))
    if len(asked) > LONGEST_LINE:
        raise CommandRefused("That is more than another program can be asked at once. Nothing was sent: ask for less.")
    try:
        line = socket.create_connection(("127.0.0.1", owner.tcp_port), CONNECT_S)
    except TimeoutError:
        raise _silent(owner) from None
    except OSError:
        raise _gone(owner) from None
    try:
        line.settimeout(ANSWER_S)
        line.sendall(asked)
    except TimeoutError:
        line.close()
        raise _silent(owner) from None
    except OSError:
        line.close()
        raise _gone(owner) from None
    return line


def _next(lines: LineReader, within_s: float | None) -> dict[str, Any]:
    """Return the next line, clean. OSError when there is none in time, ValueError for what is no object of JSON."""
    try:
        told = clean_all(json.loads(lines.read(LONGEST_ANSWER, within_s)))
    except RecursionError:
        raise ValueError("too deep a nest") from None
    if not isinstance(told, dict):
        raise ValueError("no object")
    return told


def _answer(owner: Owner, lines: LineReader, within_s: float = ANSWER_S) -> dict[str, Any]:
    try:
        told = _next(lines, within_s)
    except TimeoutError:
        raise _silent(owner) from None
    except (OSError, ValueError):
        raise _gone(owner) from None
    error = told.get("error")
    if Reason.WRONG_TOKEN in (error, error.get("reason") if isinstance(error, dict) else None):
        # The system gave its TCP port to another program.
        raise _gone(owner)
    return told


def _result(owner: Owner, request: ControlRequest, told: dict[str, Any]) -> Any:  # noqa: ANN401 - as `RESULTS`
    """Return the result in an answer. Raises the owner's error; CommandRefused where it does not understand us."""
    whose = f"The program that has {owner.port} (process {owner.pid})"
    error = told.get("error")
    if told.get("ok") is True:
        try:
            check_version(told, "The answer")
            return result_from_json(request, told.get("result"))
        except BadMessage as wrong:
            raise CommandRefused(f"{whose} has answered in another form. {wrong}") from None
    if isinstance(error, dict) and error.get("kind") != BadMessage.__name__:
        raise error_of(error)
    why = str(error.get("sentence") if isinstance(error, dict) else error).removesuffix(".")
    raise CommandRefused(f"{whose} can't do that: {why}. Nothing was sent. Is it an older birdcage?")


def _silent(owner: Owner) -> NoAnswer:
    return NoAnswer(f"Process {owner.pid} has {owner.port} and does not answer")


def _gone(owner: Owner) -> OwnerGone:
    _forget(owner)
    return OwnerGone(f"process {owner.pid} has ended")


def _read(path: Path) -> Owner | None:
    try:
        told = clean_all(json.loads(read_user_file(path)))
        return Owner(
            pid=int(told["pid"]),
            port=str(told["port"]),
            asked=str(told["asked"]),
            tcp_port=int(told["tcp_port"]),
            token=str(told["token"]),
            file=path,
        )
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _forget(owner: Owner) -> None:
    """Remove what a dead process left, unless a living one has replaced it since."""
    with contextlib.suppress(OSError):
        now = _read(owner.file)
        if now is not None and now.token == owner.token:
            owner.file.unlink()
