"""What a console looks like from outside, as data. Dialects declare it; the codec and the session read it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ConsoleDialect:
    """The grammar of one firmware's console."""

    prompts: Mapping[str, str]
    """Menu name to prompt token: `{"root": "TRK>", "mot": "MOT>"}`. Submenus are entered by their name."""
    root: str = "root"
    leave: str = "q"
    """Leaves a submenu. At the root it may kill the shell until a power cycle: see `Console.leave`."""
    line_end: bytes = b"\r"
    echo: bool = True
    refusals: tuple[tuple[re.Pattern[str], str], ...] = ()
    """Reply lines that mean that nothing was done, each with the `CommandRefused` reason it stands for."""
