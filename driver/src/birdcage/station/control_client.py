"""Asks the process that owns a port. The owner's side is `control_server`."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from birdcage.base.errors import CommandRefused
from birdcage.base.paths import Paths
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file

CONNECT_S = 1.0
LONGEST_LINE = 4096
"""Bytes of what is asked."""
WRONG_TOKEN = "wrong token"  # noqa: S105 - what an owner says of one
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


def call_owner(owner: Owner, do: str, by: str, **more: object) -> dict[str, Any]:
    """Ask the owner to `stop`, `hold`, `release`, or for its `status`, and return what it tells; `by` says who asks.

    `more` goes with it: of which features, and what to set (`control_server`).

    OwnerGone when it has ended, or ends before it answers; a file left behind by it is then removed. NoAnswer when
    it lives and keeps silent. CommandRefused when it does not know what is asked, or that is too long.
    """
    asked = json.dumps({"token": owner.token, "do": do, "by": by, **more}).encode() + b"\n"
    if len(asked) > LONGEST_LINE:
        raise CommandRefused("That is more than another program can be asked at once. Nothing was sent: ask for less.")
    try:
        with socket.create_connection(("127.0.0.1", owner.tcp_port), CONNECT_S) as line:
            line.settimeout(ANSWER_S)
            line.sendall(asked)
            with line.makefile("rb") as lines:
                reply = clean_all(json.loads(lines.readline()))
    except TimeoutError:
        raise NoAnswer(f"Process {owner.pid} has {owner.port} and does not answer") from None
    except (OSError, ValueError):
        _forget(owner)
        raise OwnerGone(f"process {owner.pid} has ended") from None
    refusal = reply.get("error") if isinstance(reply, dict) else None
    if not isinstance(reply, dict) or refusal == WRONG_TOKEN:
        # The system gave its TCP port to another program.
        _forget(owner)
        raise OwnerGone(f"process {owner.pid} has ended")
    if not reply.get("ok"):
        raise CommandRefused(
            f"The program that has {owner.port} (process {owner.pid}) can't do that: {refusal}. Nothing was sent. "
            "Is it an older birdcage?"
        )
    told = reply.get(do)
    return told if isinstance(told, dict) else {}


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
