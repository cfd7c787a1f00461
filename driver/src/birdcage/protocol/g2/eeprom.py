"""The processor's own memory, `EE>`. The firmware keeps its settings in `NVS>` instead.

Source: docs/reference/g2-commands.md, *EE>*.
"""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.trk.reading import END, garbage, search
from birdcage.protocol.trk.room import Room

_READ = re.compile(rf"Index:\s*(\d+)\s+Read value\s*=\s*([-+]?\d+){END}")
_UNWRITTEN = re.compile(rf"Failed to read eeprom index:\s*(\d+)\s+val:\s*65793{END}")


FIRST_ENTRIES = 16
"""How many entries the feature `eeprom` shows: how many there are is open."""


class Eeprom(Room):
    """Reads entries. Writing and `inv`, which loses one for good, are not here."""

    menu: ClassVar[str] = "eeprom"

    def read(self, index: int) -> int | None:
        """Read one entry (`ee <index>`); None when it was never written (`val:65793`)."""
        reply = self._run(f"ee {index}")
        unwritten, match = search(reply, _UNWRITTEN), search(reply, _READ)
        answered = unwritten or match
        if answered is None or int(answered[1]) != index:
            raise garbage(reply)
        return None if match is None else int(match[2])

    def first(self) -> tuple[str, ...]:
        """Read the first 16 entries, a line each: `--` for one that was never written."""
        values = [self.read(index) for index in range(FIRST_ENTRIES)]
        return tuple(f"{index:2}  {'--' if value is None else value}" for index, value in enumerate(values))
