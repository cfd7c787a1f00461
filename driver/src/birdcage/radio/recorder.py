"""AOS and LOS: what begins must end, and what was not understood must not be said again and again."""

from __future__ import annotations

from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.rigctl import RigctlClient
from birdcage.radio.tuning import Tuning

TRIES = 2
"""How often AOS may cost the connection before the pass goes on without it."""


class Recorder:
    """Remembers what the receiver was told of recording."""

    def __init__(self) -> None:
        self.owed: Tuning | None = None
        """The pass that LOS is owed for: AOS was taken, or may have been."""
        self.recording: bool | None = None
        """Whether AOS was taken and LOS not told yet; None if it is not known."""
        self._told = False
        """Over this connection."""
        self._failures = 0
        self._deaf = False

    def fresh(self) -> None:
        """Forget what the receiver of the pass before did not know."""
        self._failures, self._deaf, self._told = 0, False, False
        if self.owed is None:
            self.recording = None

    def disconnected(self) -> None:
        """Note that AOS has to be told again: whoever was at the other end may have started anew."""
        self._told = False

    def begin(self, rig: RigctlClient, tuning: Tuning) -> None:
        """Tell AOS, once a connection. RadioLost where that cost the connection."""
        if self._told or self._deaf:
            return
        try:
            rig.word("AOS")
        except RadioRefused:
            # rigctld takes it for `A OS`. LOS would swallow the command after it there, so it is never told.
            self._deaf = True
            self.recording = self.owed = None
        except RadioLost:
            self.owed = tuning
            self.recording = None
            self._failures += 1
            self._deaf = self._failures >= TRIES
            raise
        else:
            self.owed, self.recording, self._told = tuning, True, True

    def end(self, rig: RigctlClient) -> None:
        """Tell LOS where it is owed. RadioLost if it may not have been heard."""
        if self.owed is None:
            return
        sure = self.recording
        try:
            rig.word("LOS")
        except RadioRefused:
            self.recording = None
        except RadioLost:
            if not sure:  # AOS was not answered either: there is no more to be done
                self.owed = None
            raise
        else:
            self.recording = False if sure else None
        self.owed = None

    def give_up(self) -> None:
        """Stop owing: no receiver answers any more."""
        self.owed = self.recording = None
