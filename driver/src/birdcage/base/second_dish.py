"""The settings of a second dish of one program: a `birdcage.toml` of its own, and no flag or variable over it."""

from __future__ import annotations

import os
from pathlib import Path

from birdcage.base.config import Settings, load
from birdcage.base.errors import ConfigError
from birdcage.base.paths import Paths


def second_dish(paths: Paths, file: str, first_port: str | None) -> tuple[Paths, Settings]:
    """Return where its files are and what its settings say; `file` is what `--also` named.

    ConfigError where that is no file, names no port, or the port of the first dish.
    """
    path = Path(file)
    if not path.is_file():
        raise ConfigError(
            f"{file} (--also) is not a file. A second dish needs a birdcage.toml of its own, with its [dish], limits "
            "and alignment."
        )
    own = paths.with_config(path)
    settings = load(path, environ={})
    port = settings.dish.port
    if port is None:
        raise ConfigError(f"{file} (--also) names no port. Write `port` into its [dish].")
    if first_port is not None and _real(port) == _real(first_port):
        raise ConfigError(f"{file} (--also) names {port}, as the first dish does. Each dish needs a port of its own.")
    return own, settings


def _real(port: str) -> str:
    """Return one name for all names of a device."""
    return port if "://" in port or port.startswith("sim:") else os.path.realpath(port)
