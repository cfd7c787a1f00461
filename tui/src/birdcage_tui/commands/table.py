"""What a command is, and why one cannot be given now."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage_tui.shown.allowed import CommandContext

Reason = Callable[[CommandContext], str | None]
"""Why a command cannot be given now, as a sentence; None when it can."""


def always(_: CommandContext) -> str | None:
    """Nothing is ever in the way."""
    return None


@dataclass(frozen=True, slots=True)
class Command:
    """One thing a person can do. `keys` are Textual's names; `shown` is how the key is written."""

    name: str
    keys: tuple[str, ...]
    shown: str
    title: str
    help: str
    group: str
    refused: Reason = always
    footer: str = ""
    """The word in the footer; not there when empty."""
    where: tuple[str, ...] = ()
    """The scopes (pages, or widgets with a `scope`) that it belongs to and that do it; empty: everywhere."""
    priority: bool = False
    """Whether its key is taken before the widget that has the focus sees it."""
    page: str = ""
    """The page on which its scope is, where that is a widget's."""
    footer_still: str = ""
    """The word instead while the dish can't be moved; empty: the same."""
