"""What one face types at the pursuit desk: each face searches and locates for itself."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.pursuit.now import DeskNow, TargetMatch
from birdcage.pursuit.pointer import Pointer

if TYPE_CHECKING:
    from collections.abc import Callable

    from birdcage.base.clock import Clock
    from birdcage.pursuit.plan_keeper import PlanKeeper


OWN = ""
"""The face of the desk's own program."""


class FaceSearch:
    """For the desk's thread alone."""

    def __init__(self, plans: PlanKeeper) -> None:
        self._plans, self._query = plans, ""
        self._found: tuple[TargetMatch, ...] = ()
        self._note = ""
        self.pointer = Pointer(plans.finder)

    def search(self, text: str, now: datetime) -> None:
        """Look for targets."""
        self._query = text
        self._plans.finder.refresh()
        self.look_again(now)

    def look_again(self, now: datetime) -> None:
        """Search again: the catalogue may have changed."""
        self._found, self._note = self._plans.finder.search(self._query, now, self._plans.observer)

    def seen(self, shown: DeskNow) -> DeskNow:
        """Return what this face is shown."""
        refraction = self._plans.settings.tracking.refraction
        located = self.pointer.look(self._plans.observer, shown.utc, refraction)
        return replace(shown, query=self._query, found=self._found, found_note=self._note, located=located)


class FaceSearches:
    """Those of all faces at a desk, by name. For the desk's thread alone; a face that is gone asks for nothing."""

    def __init__(self, plans: PlanKeeper, clock: Clock, changed: Callable[[], object]) -> None:
        self._plans, self._clock, self._changed = plans, clock, changed
        self._faces = {OWN: FaceSearch(plans)}

    def join(self, face: str) -> None:
        """Let another face search for itself."""
        self._faces[face] = FaceSearch(self._plans)
        self._changed()

    def part(self, face: str) -> None:
        """Forget what a face searched: it is gone."""
        self._faces.pop(face, None)

    def search(self, text: str, face: str) -> None:
        """Look for targets."""
        if face in self._faces:
            self._faces[face].search(text, self._clock.utc())
            self._changed()

    def locate(self, text: str, face: str) -> None:
        """Say where a target stands from now on; empty: no longer."""
        if face in self._faces:
            self._faces[face].pointer.ask(text)
            self._changed()

    def look_again(self, now: datetime) -> None:
        """Search again for all of them: the catalogue has changed."""
        for face in self._faces.values():
            face.look_again(now)
            face.pointer.forget()

    @property
    def locate_something(self) -> bool:
        """Whether one of them wants to know where a target stands."""
        return any(face.pointer.text for face in self._faces.values())

    def seen_by(self, face: str, shown: DeskNow) -> DeskNow:
        """Return what a face is shown: what all are, and what it searches itself."""
        own = self._faces.get(face)
        return shown if own is None else own.seen(shown)
