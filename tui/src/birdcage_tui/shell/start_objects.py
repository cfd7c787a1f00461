"""What the start of the program has made: kept out of the garbage collector's sight while the app runs."""

from __future__ import annotations

import gc


class StartObjects:
    """Freezes what lives as long as the app, which a full collection would look at while STOP waits behind it.

    Only for a program that started with its collector off, as `main` does: the process of anybody else, who may run
    one app after the other, keeps its collector as it is. At its end the app leaves things as it found them.
    """

    def __init__(self) -> None:
        self._frozen = False

    def freeze(self) -> None:
        """Set aside all objects that there are, and begin to collect what is made from now on."""
        if gc.isenabled():
            return
        self._frozen = True
        gc.freeze()
        gc.enable()

    def thaw(self) -> None:
        """Hand over what was set aside, the collector off again: the program ends, or begins anew with the next app."""
        if self._frozen:
            self._frozen = False
            gc.disable()
            gc.unfreeze()
