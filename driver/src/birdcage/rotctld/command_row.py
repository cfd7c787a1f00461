"""What a row of the table of commands holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from birdcage.rotctld.arguments import ArgumentShape
from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.result import AwaitedResult, CommandResult

Call = Callable[[ClientContext, Sequence[str]], CommandResult | AwaitedResult]
"""Does a command. It gets its arguments as tokens that fit their shapes, and may raise `RotctldError`."""


@dataclass(frozen=True, slots=True)
class CommandRow:
    r"""One command: what it is called, what stands behind it, and what it does.

    `long` follows a backslash: `\get_pos`. `short` is its letter, empty where it has none.
    """

    long: str
    short: str
    call: Call
    arguments: tuple[ArgumentShape, ...] = ()
    alone: bool = False
    """Its letter means it only at the end of a line: with arguments the letter is another's. It needs no argument."""
    splits: bool = False
    """Its two numbers may be one token, `10.5,20.5`, where points tell what the comma is."""
    word: bool = False
    """Its long name may do without the backslash: it has an underscore, or it stops the dish."""
