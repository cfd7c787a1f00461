"""The one table of commands: it makes the keys, the footer, the palette, the help and the mouse targets."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from birdcage_tui.commands.calibrate import CALIBRATE
from birdcage_tui.commands.cards import CARDS
from birdcage_tui.commands.console import CONSOLE
from birdcage_tui.commands.control import CONTROL
from birdcage_tui.commands.everywhere import APP, DISHES, MOTION, PAGE_COMMANDS, PAGES, SAFETY, SEARCH
from birdcage_tui.commands.horizon import HORIZON
from birdcage_tui.commands.jog import JOG
from birdcage_tui.commands.network import NETWORK
from birdcage_tui.commands.passes import PASSES
from birdcage_tui.commands.pocket import POCKET
from birdcage_tui.commands.receiver import RECEIVER
from birdcage_tui.commands.resume import RESUME
from birdcage_tui.commands.setup import SETUP
from birdcage_tui.commands.signal import SIGNAL
from birdcage_tui.commands.sky_map import SKY_MAP
from birdcage_tui.commands.system import SYSTEM
from birdcage_tui.commands.table import Command
from birdcage_tui.commands.track import TRACK

__all__ = ["BY_NAME", "COMMANDS", "KEYS", "PAGES", "Command", "for_key", "in_force"]

COMMANDS: tuple[Command, ...] = (
    *SAFETY, *JOG, *CONTROL, *HORIZON, *TRACK, *NETWORK, *CARDS, *SIGNAL, *SKY_MAP, *RECEIVER, *PASSES, *POCKET,
    *CONSOLE, *CALIBRATE, *SETUP, *SYSTEM, *MOTION, *RESUME, *SEARCH, *APP, *DISHES, *PAGE_COMMANDS,
)  # fmt: skip
BY_NAME = {command.name: command for command in COMMANDS}
KEYS: dict[str, bool] = {
    key: any(command.priority for command in COMMANDS if key in command.keys)
    for command in COMMANDS
    for key in command.keys
}
"""Every key that any command has, and whether it is taken before the focused widget sees it."""


_BY_KEY: dict[tuple[str, str | None], Command] = {
    (key, scope): command for command in COMMANDS for key in command.keys for scope in command.where or (None,)
}
"""What each key does in a scope; None: in every scope that gives the key no meaning of its own."""


def _rank(command: Command, scopes: Sequence[str]) -> int | None:
    """Return how near the command is to what has the focus; None when it is not in force there."""
    if not command.where:
        return len(scopes)
    return next((rank for rank, scope in enumerate(scopes) if scope in command.where), None)


def for_key(key: str, scopes: Sequence[str]) -> Command | None:
    """Return what a key does in these scopes, innermost first; None when it does nothing there."""
    for scope in (*scopes, None):
        command = _BY_KEY.get((key, scope))
        if command is not None:
            return command
    return None


def in_force(scopes: Sequence[str]) -> tuple[Command, ...]:
    """Return the commands that hold in these scopes: safety, then nearest first; one under a nearer key is left out."""
    return _in_force(tuple(scopes))


@lru_cache(maxsize=64)
def _in_force(scopes: tuple[str, ...]) -> tuple[Command, ...]:
    """Do it once for each place: the footer asks in every frame."""
    ranked = sorted(
        ((-1 if command in SAFETY else rank, command) for command in COMMANDS
         if (rank := _rank(command, scopes)) is not None),
        key=lambda pair: pair[0],
    )  # fmt: skip
    return tuple(
        command for _, command in ranked
        if not command.keys or any(for_key(key, scopes) is command for key in command.keys)
    )  # fmt: skip
