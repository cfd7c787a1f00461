"""Says where a target stands that somebody types, as long as he does: what the go-to line asks for."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.pursuit.now import NO_PLACE, Located

if TYPE_CHECKING:
    from birdcage.pursuit.finder import Finder
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Resolution, Target
    from birdcage.tracking.planning.refraction import Refraction


def brief(meant: Resolution) -> str:
    """Return why nothing is found in two rows of a terminal."""
    from birdcage.sky.targets.problems import UNDERSTOOD

    return meant.problem.replace(UNDERSTOOD, "Type a satellite, moon, polaris, 28.2E, dish 119 or 180 45.")


class BelowWords:
    """Says of a target that it is below the horizon, and when it rises: worked out once a minute."""

    def __init__(self) -> None:
        self._of: tuple[Target, int] | None = None
        self._words = ""

    def of(self, target: Target, observer: Observer, now: datetime) -> str:
        """Return the sentence; empty for what is up. BirdcageError where it has no position."""
        from birdcage.sky.targets.sight import below_words

        of = target, int(now.timestamp() // 60.0)
        if of != self._of:
            self._of, self._words = of, below_words(target, observer, now)
        return self._words


class Pointer:
    """Looks one text up, and where that stands as often as it is asked. For one thread alone."""

    def __init__(self, finder: Finder) -> None:
        self._finder = finder
        self._meant: Resolution | None = None
        self.text = ""
        """What was typed; empty without a question."""
        self._below = BelowWords()

    def ask(self, text: str) -> None:
        """Take another text."""
        if text != self.text:
            self.text = text
            self.forget()

    def forget(self) -> None:
        """Look it up again: the catalogue has changed."""
        self._meant = None

    def look(self, observer: Observer | None, now: datetime, refraction: Refraction) -> Located | None:
        """Return where it stands; None without a question."""
        if not self.text.strip():
            return None
        if self._meant is None:
            self._finder.refresh()
            self._meant = self._finder.resolve(self.text)
        meant = self._meant
        if meant.found is None:
            return Located(self.text, several=meant.reason is Reason.AMBIGUOUS, problem=brief(meant))
        name = meant.target.name
        if observer is None:
            return Located(self.text, name, meant.exact, problem=NO_PLACE)
        try:
            seen = meant.target.look(observer, now)
            below = self._below.of(meant.target, observer, now) if seen.el_deg <= 0.0 else ""
        except BirdcageError as error:
            below = str(error)
        if below:
            return Located(self.text, name, meant.exact, problem=" ".join(filter(None, (below, meant.note))))
        from birdcage.sky.targets.model import SlotTarget
        from birdcage.tracking.planning.refraction import lift_deg

        fixed = meant.target.kind == "fixed"
        el_deg = seen.el_deg + (0.0 if fixed else float(lift_deg(seen.el_deg, refraction)))
        silence = "" if meant.found.silence is None else meant.found.silence.brief
        skew = meant.target.skew(observer) if isinstance(meant.target, SlotTarget) else None
        turned = "" if skew is None else skew.brief()
        return Located(self.text, name, meant.exact, az_deg=seen.az_deg, el_deg=el_deg, silence=silence, skew=turned)
