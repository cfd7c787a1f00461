"""A second dish beside the one that is wanted: each has a `birdcage.toml` of its own."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.second_dish import second_dish
from birdcage.cli.options import DEFAULT_FIRMWARE
from birdcage.cli.say import say

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted


def also_wanted(first: Wanted, file: str) -> Wanted:
    """Return the dish of which `file` tells, a `birdcage.toml`. Flags and variables are the first dish's.

    ConfigError where that is no file, names no port, or the first dish's.
    """
    paths, settings = second_dish(first.paths, file, first.port)
    for problem in settings.problems:
        say(problem.text)
    dish = settings.dish
    assert dish.port is not None, "second_dish refuses that"
    return replace(
        first, port=dish.port, port_given=True, firmware=dish.firmware or DEFAULT_FIRMWARE,
        firmware_given=dish.firmware is not None, baud=dish.baud, settings=settings, paths=paths, flags={}, environ={},
    )  # fmt: skip
