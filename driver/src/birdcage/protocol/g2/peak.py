"""The menu of peaking and switches, `PEAK>` (docs/reference/g2-commands.md, *PEAK>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.trk.reading import END, find, garbage
from birdcage.protocol.trk.room import Room

_SIGNALS = re.compile(rf"Even_sig\s*=\s*(\d+)\s*,?\s*Odd_sig\s*=\s*(\d+){END}")
_SWITCH = re.compile(rf"SW Status:\s*0b([01]+)\s+(\d+){END}")
_TOGGLE_S = 10.0


class Peak(Room):
    """Levels and switch. `pw`, `pxy1` and perhaps `psnr` move the dish and are not here, nor is `stb`."""

    menu: ClassVar[str] = "peak"

    def rssi(self) -> tuple[int, int]:
        """Read the level in counts at 18 V (horizontal, even transponders) and at 13 V (vertical, odd ones): `rssits`.

        It switches the LNB's supply meanwhile. An empty sky has shown 489 and 235.
        """
        match = find(self._run("rssits", takes_s=_TOGGLE_S), _SIGNALS)
        return int(match[1]), int(match[2])

    def switch_status(self) -> int:
        """Read the four bits of an EchoStar switch (`ts`); 0 when there is none."""
        reply = self._run("ts")
        match = find(reply, _SWITCH)
        status = int(match[1], 2)
        if status != int(match[2]):
            raise garbage(reply)
        return status
