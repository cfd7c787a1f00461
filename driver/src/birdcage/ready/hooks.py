"""What runs beside the dish: the user's own commands."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from birdcage.ready.check import Check

if TYPE_CHECKING:
    from birdcage.base.config import Settings


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
            yield Check("hooks", "hooks", "look", f"{key} cannot be read: {error}", "birdcage config path")
            return
        if not words or shutil.which(words[0]) is None:
            missing = f"there is no program {words[0]!r}" if words else "it is empty"
            yield Check("hooks", "hooks", "look", f"{key}: {missing}", "birdcage config path")
            return
    if commands:
        yield Check("hooks", "hooks", "good", f"{', '.join(commands)} can be started")
