"""What the app goes by when it begins again, because a person has chosen another firmware in the setup of a dish."""

from __future__ import annotations

import argparse

from birdcage.base.config import load
from birdcage.base.machine_port import port_of
from birdcage.base.paths import Paths


def take_chosen(options: argparse.Namespace, paths: Paths, number: int) -> None:
    """Go by what the setup of a dish, from 1, has kept; for the first one it counts over flag and variable.

    Those are not a second dish's, which goes by its own file anyway.
    """
    if number == 1:
        kept = load(paths.config_file, environ={}).dish
        options.firmware, options.baud = kept.firmware, None
        options.port = port_of(kept.firmware or "", options.port, kept.port)
    elif options.demo:
        options.also = load(second_demo_paths(paths).config_file, environ={}).dish.firmware


def second_demo_paths(paths: Paths) -> Paths:
    """Return where the second dish of a demo keeps its files."""
    return paths.with_config(paths.config_file.with_name("second.toml"))
