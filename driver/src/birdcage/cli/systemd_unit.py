"""A unit of systemd that keeps a station running for this user, as it is installed here."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.cli import exits

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted

NAME = "birdcage-station.service"
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
KEPT = ("BIRDCAGE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME")
"""Variables that say where files are: a station under systemd must find the ones that are found here."""


def station_unit(wanted: Wanted, *, skip_init: bool) -> str:
    """Return the unit: the same port, firmware, speed and settings as are wanted now."""
    words = [*_program(), "station", "run", "--port", wanted.port]
    if wanted.firmware_given:
        words += ["--firmware", wanted.firmware]
    if wanted.baud is not None:
        words += ["--baud", str(wanted.baud)]
    if wanted.paths.config_file.is_file():
        words += ["--config", str(wanted.paths.config_file)]
    words += ["--skip-init"] if skip_init else []
    kept = "".join(f"Environment={_quoted(f'{name}={os.environ[name]}')}\n" for name in KEPT if name in os.environ)
    folder = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "systemd/user"
    return UNIT.format(
        file=folder / NAME, name=NAME, port=wanted.port.replace("%", "%%"), command=" ".join(map(_quoted, words)),
        ended=exits.SIGNAL + 15, usage=exits.USAGE, environment=kept,
    )  # fmt: skip


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
