"""Which firmware a command speaks: as flag, variable or settings say, and where none does, the port is asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock, RealClock
from birdcage.base.errors import ConfigError, NoReply
from birdcage.base.reason import Reason
from birdcage.cli.options import Wanted
from birdcage.cli.say import Progress, say

if TYPE_CHECKING:
    from birdcage.detection.detecting import Detection


def with_firmware(
    dish: Wanted, *, clock: Clock | None = None, patience_s: float = 0.0, must_open: bool = False
) -> Wanted:
    """Return the dish with its firmware: as it was named, or as the port tells.

    A port that stays silent is left to the default, which is then tried; so is one that can't be opened, for the
    session to say so, unless `must_open`: LinkError then. With `patience_s` a dish that starts is asked again for so
    long instead. NoReply (`wrong_firmware`) for what talks and is no firmware that is known, ConfigError where two
    cannot be told apart: both say to name it.
    """
    if dish.firmware_given:
        return dish
    clock = clock or RealClock()
    until = clock.monotonic() + patience_s
    while not (found := ask_port(dish, clock)).is_told and clock.monotonic() < until:
        pass
    if found.firmware is not None:
        say(found.sentence)
        return take(dish, found, found.firmware)
    if found.candidates:
        raise ConfigError(found.sentence)
    if found.talks:
        raise NoReply(found.sentence, reason=Reason.WRONG_FIRMWARE)
    if patience_s and found.trouble is None:
        raise NoReply(found.sentence)
    if must_open and found.trouble is not None:
        raise found.trouble
    return dish


def ask_port(dish: Wanted, clock: Clock, *, log: bool = True, tell: Callable[[str], None] | None = None) -> Detection:
    """Ask the port which firmware answers, at the rate of the named one first."""
    from birdcage.detection.detecting import LOG_S, detect_firmware

    progress = Progress()
    first = dish.named_model
    found = detect_firmware(
        dish.port, clock, baud=dish.baud, first=None if first is None else first.baud, log_s=LOG_S if log else 0.0,
        tell=tell or progress.show,
    )  # fmt: skip
    progress.clear()
    return found


def take(dish: Wanted, found: Detection, firmware: str) -> Wanted:
    """Return the dish with a firmware that was found, at the rate at which it was."""
    return replace(dish, firmware=firmware, firmware_given=True, baud=dish.baud or found.baud)
