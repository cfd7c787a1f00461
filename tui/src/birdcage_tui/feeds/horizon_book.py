"""The horizon as the app has it: changed through the file, changes taken back, rests after jogs recorded."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.errors import ConfigError
from birdcage.base.geometry import shortest_turn
from birdcage.sky.horizon import HorizonMask, horizon_words

from birdcage_tui.feeds.settings import HorizonFile
from birdcage_tui.shown.horizon_state import HorizonState, count_text

if TYPE_CHECKING:
    from birdcage.skymap.horizon_lesson import HorizonEdge

REST_S = 1.0
"""The dish has to stand so long after a jog before that is a point: steps in a row are one way."""
SAME_DEG = 0.02
"""Two readings that differ by less are of a dish at rest."""
KEPT_CHANGES = 64
NO_FILE = "This app has no horizon file."


@dataclass(frozen=True, slots=True)
class Rest:
    """A first look at a dish that rests: where, and at which monotonic second."""

    az_deg: float
    el_deg: float
    at: float


class HorizonBook:
    """Each change returns a sentence for a person. ConfigError says why nothing was changed."""

    def __init__(self, file: HorizonFile | None) -> None:
        self._file = file
        self.mask = HorizonMask() if file is None else file.begin
        """As it counts now."""
        self._before: list[HorizonMask] = []
        self.recording = False
        """Whether each rest after a jog becomes a point."""
        self._jogged = False
        self._rest: Rest | None = None

    @property
    def known(self) -> HorizonMask | None:
        """The mask; None if this app keeps none, so that another's counts."""
        return None if self._file is None else self.mask

    @property
    def state(self) -> HorizonState:
        """What a frame shows."""
        return HorizonState(self.mask, self.recording, bool(self._before), NO_FILE if self._file is None else "")

    # Changes.

    def mark(self, az_deg: float, el_deg: float) -> str:
        """Keep a point; one at that azimuth was measured again and is replaced."""
        self._change(lambda mask: mask.insert(az_deg, el_deg))
        more = "" if self.mask.is_line else " It applies to all azimuths until you add more."
        return f"Horizon {el_deg:.1f}° at {az_deg % 360.0:.1f}° saved, {count_text(self.mask)}.{more}"

    def draw(self, mask: HorizonMask) -> str:
        """Keep a horizon that was drawn as a whole."""
        self._change(lambda _: mask)
        return f"Saved the drawn horizon, {count_text(self.mask)}. z: undo."

    def accept(self, points: Sequence[HorizonEdge], accepted: Collection[int]) -> str:
        """Keep those points of a proposed horizon whose index was accepted; what stands beside them stays."""
        from birdcage.skymap.horizon_accepted import with_accepted

        self._change(lambda mask: with_accepted(mask, points, accepted))
        return f"Saved: {horizon_words(self.mask.points)}. z on F2 takes it back."

    def clear(self) -> str:
        """Make it flat."""
        self._change(lambda _: HorizonMask())
        return "The horizon is flat now. z: undo."

    def undo(self) -> str:
        """Take back the last change."""
        if not self._before:
            raise ConfigError("No horizon changes to undo.")
        file, before = self._writable(), self._before[-1]
        gone = [point for point in self.mask.points if point not in before.points]
        file.write(before)
        self._before.pop()
        self.mask = before
        what = f"{gone[0][1]:.1f}° at {gone[0][0]:.1f}°" if len(gone) == 1 else "the last change"
        return f"Horizon: undid {what}, {count_text(before)}."

    def _change(self, change: Callable[[HorizonMask], HorizonMask]) -> None:
        file = self._writable()
        # The setup or another program may have written it since: what stands there is what is changed.
        there = file.read()
        if there != self.mask:
            self._before.clear()
        after = change(there)
        file.write(after)
        self._before = [*self._before[-KEPT_CHANGES:], there]
        self.mask = file.read()

    def place_changed(self) -> None:
        """Take the horizon of another place; where it can't be read, the one before stays."""
        if self._file is None:
            return
        with suppress(ConfigError):
            self.mask = self._file.read()
            self._before.clear()

    def _writable(self) -> HorizonFile:
        if self._file is None:
            raise ConfigError(NO_FILE)
        return self._file

    # Recording.

    def record(self, on: bool) -> str:
        """Begin or end recording."""
        self.recording, self._jogged, self._rest = on, False, None
        if on:
            return f"Recording the horizon: jog along the tree line. Each rest of {REST_S:g} s adds a point."
        return f"Recording ended: the horizon has {count_text(self.mask)}." if self.mask else "Recording ended: flat."

    def moved(self, *, jog: bool) -> None:
        """Take notice of a motion that was asked for: only where a jog ends is a point."""
        self._jogged, self._rest = self.recording and jog, None

    def rest(self, az_deg: float, el_deg: float, read_at: float, now: float) -> bool:
        """Take a look at a dish that rests, as read at a monotonic second. Return whether it is a point, once."""
        if not (self.recording and self._jogged):
            return False
        first = self._rest
        moved = first is None or max(abs(shortest_turn(first.az_deg, az_deg)), abs(first.el_deg - el_deg)) > SAME_DEG
        if first is None or moved:
            self._rest = Rest(az_deg, el_deg, now)
            return False
        if now - first.at < REST_S or read_at < first.at:
            return False
        self._jogged, self._rest = False, None
        return True

    def unrest(self) -> None:
        """Take notice that it does not rest."""
        self._rest = None
