"""What `birdcage ready` looks at beside the dish: the receiver, and the user's own commands."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from birdcage.cli.ready_checks import Check

if TYPE_CHECKING:
    from birdcage.base.config import Settings

RADIO_S = 1.0


def radio(settings: Settings) -> Iterator[Check]:
    """Whether the receiver answers, where one is set. It is asked for its frequency, and left as it is."""
    address = settings.radio.rigctld
    if address is None:
        return
    from birdcage.base.errors import ConfigError
    from birdcage.radio.errors import RadioLost
    from birdcage.radio.probe import ask_frequency

    try:
        freq_hz = ask_frequency(address, RADIO_S)
    except ConfigError as error:
        yield Check("radio", "look", str(error), "birdcage config path")
    except RadioLost as error:
        remedy = f"start rigctld, SDR++ or gqrx at {address}"
        if error.reason == "silent":
            remedy = "rigctld without --vfo; SDR++ answers one program at a time"
        yield Check("radio", "look", str(error), remedy)
    else:
        tuned = "" if freq_hz is None else f", tuned to {freq_hz / 1e6:.10g} MHz"
        yield Check("radio", "good", f"{address} answers{tuned}")


def hooks(settings: Settings) -> Iterator[Check]:
    """Whether the commands that are set can be found. None is run."""
    import shlex
    import shutil

    commands = {
        key: command
        for key in ("at_reach_start", "at_tca", "at_reach_end")
        if (command := getattr(settings.hooks, key)) is not None
    }
    for key, command in commands.items():
        try:
            words = shlex.split(command)
        except ValueError as error:
            yield Check("hooks", "look", f"{key} cannot be read: {error}", "birdcage config path")
            return
        if not words or shutil.which(words[0]) is None:
            missing = f"there is no program {words[0]!r}" if words else "it is empty"
            yield Check("hooks", "look", f"{key}: {missing}", "birdcage config path")
            return
    if commands:
        yield Check("hooks", "good", f"{', '.join(commands)} can be started")
