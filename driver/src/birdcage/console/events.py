"""What the codec makes of a stream of bytes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Reply:
    """A command that was echoed, and answered by a prompt.

    `lines` hold neither echo, prompt nor blank lines; `menu` is what the prompt `token` names; `ticket` is what
    `Codec.expect` gave out for the command.
    """

    command: str
    lines: tuple[str, ...]
    menu: str
    token: str
    ticket: int


@dataclass(frozen=True, slots=True)
class ReplyLine:
    """A whole line inside the reply that is being received: homing and boot tell their progress so."""

    text: str
    ticket: int


@dataclass(frozen=True, slots=True)
class Stray:
    """A line that no command asked for."""

    text: str


@dataclass(frozen=True, slots=True)
class StrayPrompt:
    """A prompt that no command in hand asked for: late, doubled, or after a reboot."""

    menu: str


Event = Reply | ReplyLine | Stray | StrayPrompt

LineSink = Callable[[str], None]
