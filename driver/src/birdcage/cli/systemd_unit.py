"""Units of systemd that keep a station or a server running for this user, as it is installed here."""

from __future__ import annotations

import os
import shutil
import socket
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.cli import exits

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted

STATION, SERVER, SOCKET = "birdcage-station.service", "birdcage-rotctld.service", "birdcage-rotctld.socket"
UNIT = """\
# Save this as {file}, then:
#   systemctl --user daemon-reload
#   systemctl --user enable --now {name}
#   loginctl enable-linger        (it then runs while no user is logged in)
# Its words: journalctl --user -u {name} -f

[Unit]
Description=birdcage: the dish at {port}

[Service]
Type=exec
ExecStart={command}
# SIGTERM sends STOP first. That, and giving the port back, take some seconds.
TimeoutStopSec=20
SuccessExitStatus={ended}
Restart=on-failure
RestartSec=5
# Wrong settings stay wrong.
RestartPreventExitStatus={usage}
{environment}
[Install]
WantedBy=default.target
"""
SOCKET_UNIT = """\
# Save this as {file}, and beside it what
# `birdcage serve --print-systemd service` prints, as {service}. Then:
#   systemctl --user daemon-reload
#   systemctl --user enable --now {name}
# systemd listens. The first client starts birdcage, which gets the socket; the client waits for that.

[Unit]
Description=birdcage: the port for Gpredict and others

[Socket]
ListenStream={address}

[Install]
WantedBy=sockets.target
"""
KEPT = ("BIRDCAGE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME")
"""Variables that say where files are: a station under systemd must find the ones that are found here."""


def station_unit(wanted: Wanted, *, skip_init: bool, also: str | None = None) -> str:
    """Return the unit: the same port, firmware, speed and settings as are wanted now; `also` is the second dish's."""
    second = [] if also is None else ["--also", str(Path(also).resolve())]
    return _service(STATION, ["station", "run"], wanted, [*(["--skip-init"] if skip_init else []), *second])


def server_unit(wanted: Wanted, options: Sequence[str]) -> str:
    """Return the same for `birdcage serve` with these options of its own."""
    return _service(SERVER, ["serve"], wanted, options)


def socket_unit(host: str, port: int) -> str:
    """Return the unit of the socket that starts that server. OSError for a host of which no address is known."""
    found = socket.getaddrinfo(host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    family, _, _, _, address = found[0]
    where = f"[{address[0]}]:{port}" if family == socket.AF_INET6 else f"{address[0]}:{port}"
    return SOCKET_UNIT.format(file=_folder() / SOCKET, name=SOCKET, service=SERVER, address=where)


def _service(name: str, command: list[str], wanted: Wanted, options: Sequence[str]) -> str:
    words = [*_program(), *command, "--port", wanted.port]
    if wanted.firmware_given:
        words += ["--firmware", wanted.firmware]
    if wanted.baud is not None:
        words += ["--baud", str(wanted.baud)]
    if wanted.paths.config_file.is_file():
        words += ["--config", str(wanted.paths.config_file)]
    words += options
    kept = "".join(f"Environment={_quoted(f'{name}={os.environ[name]}')}\n" for name in KEPT if name in os.environ)
    return UNIT.format(
        file=_folder() / name, name=name, port=wanted.port.replace("%", "%%"), command=" ".join(map(_quoted, words)),
        ended=exits.SIGNAL + 15, usage=exits.USAGE, environment=kept,
    )  # fmt: skip


def _folder() -> Path:
    """Return where systemd looks for units of this user."""
    return Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "systemd/user"


def _program() -> list[str]:
    """Return how this program is started: by the script that belongs to this Python, else by Python itself."""
    script = Path(sys.executable).with_name("birdcage")
    found = str(script) if os.access(script, os.X_OK) else shutil.which("birdcage")
    return [found] if found is not None else [sys.executable, "-c", "from birdcage.cli import main; main()"]


def _quoted(word: str) -> str:
    """Return a word as systemd reads it: in quotes where it has to be, `%` and `$` doubled."""
    word = word.replace("\\", "\\\\").replace("%", "%%").replace("$", "$$")
    plain = word and not any(letter.isspace() or letter in "\"';" for letter in word)
    return word if plain else '"' + word.replace('"', '\\"') + '"'
