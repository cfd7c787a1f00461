"""HELD for scripts that drive a dish without a station: what a person has stopped, no script moves."""

from __future__ import annotations

from birdcage.base.errors import Held
from birdcage.base.held import HeldFile
from birdcage.base.paths import Paths
from birdcage.link.identity import dish_folder, dish_identity


class Latch:
    """The latch of the dish at one port, which another program may set or release at any time."""

    def __init__(self, port: str) -> None:
        """Look for the dish at `port`; one that is simulated in this program is held by none."""
        identity = dish_identity(port)
        self._file = None if identity is None else HeldFile(dish_folder(Paths.default().state, identity))

    def check(self) -> None:
        """Raise `Held` while a person has stopped the dish."""
        note = None if self._file is None else self._file.read()
        if note is not None:
            raise Held(f"{note.sentence} Nothing was sent: `birdcage release` lets it move again.")
