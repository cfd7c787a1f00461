"""The commands of a console's menus: as they are documented, and as the dish's own help lists them."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.rotator.raw import CommandDoc

_ENTER = re.compile(r"Enter <(\S+)>\s*(?:-\s*(.*))?", re.IGNORECASE)
_COMMAND = re.compile(r"([A-Za-z?][\w?*]*)((?:\s+[\[<(]\S.*?[\])>])*)\s*(?:(?:\s-|:|\s{2,}|\t)\s*(.*))?")


def parse_help(menu: str | None, lines: Iterable[str]) -> tuple[CommandDoc, ...]:
    """Read what `?` printed (`docs/reference/g2.md`, *Menus*), leniently: a line that is none of its forms is left out.

    Forms: `Enter <dvb> - DVB Tuner`, `help [<command>]`, `a [<motor> <angle>]`, `agc - reads the AGC`, bare words.
    """
    found: dict[str, CommandDoc] = {}
    for line in map(str.strip, lines):
        if enter := _ENTER.fullmatch(line):
            found[enter[1]] = CommandDoc(menu, enter[1], enter[1], (enter[2] or "").strip())
        elif command := _COMMAND.fullmatch(line):
            name = command[1]
            found[name] = CommandDoc(menu, name, f"{name}{command[2]}", (command[3] or "").strip())
    return tuple(found.values())
