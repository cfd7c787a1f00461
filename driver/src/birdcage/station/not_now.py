"""The command with which the owner says whether the dish may move while he is away: wind, rain, a child in the garden.

It says *go on* by ending with status 0. Any other status is *not now*, and its first line says why. A command that
can't be started, or gives no answer in `ANSWER_S`, counts as *not now* too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from birdcage.base.user_command import UserCommand

ANSWER_S = 5.0
"""How long the command may take; real seconds."""


class NotNowAnswer(Protocol):
    """A command that runs, or has ended."""

    @property
    def over(self) -> bool:
        """Whether it has ended."""

    @property
    def status(self) -> int | None:
        """Its exit status; None if it could not be started."""

    @property
    def first_line(self) -> str:
        """What it printed first; empty if it printed nothing."""


def start(command: str) -> NotNowAnswer:
    """Start the command. It is told nothing."""
    return UserCommand(command, {}, "", lambda _text: None, deadline_s=ANSWER_S)


@dataclass(frozen=True, slots=True)
class NotNow:
    """The command, and how often it is asked while the dish moves unattended, or is about to."""

    command: str
    every_s: float = 5.0
    park: tuple[float, float] | None = None
    """Where the dish goes then, true azimuth and elevation; None: it stays where it comes to rest."""
    ask: Callable[[str], NotNowAnswer] = start
    """Starts it."""
