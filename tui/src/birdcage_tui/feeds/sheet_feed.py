"""Reads what a tab of the System page shows, as soon as somebody looks at it, and sets what is changed there."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from functools import partial

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.rotator.feature import Feature, FeatureKind, FeaturePage, Reading, Value
from birdcage.station.access import FaceStation
from birdcage.station.requests import Read, Set

from birdcage_tui.shown.system_sheet import OLD_S, FeatureChange, SheetNow, features_on, waits_for
from birdcage_tui.shown.view import YOU

LOOKED_S = 3.0
"""A page that was not drawn for so long is hidden: what has not been asked for by then is not."""
SOON_LINES = 4
"""What takes more lines than this is read after the rest."""


class SheetFeed:
    """For the app's thread. One question at a time: the station may be asked for something else in between."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Callable[[], None]], object],
        changed: Callable[[], object],
    ) -> None:  # fmt: skip
        self._station, self._clock, self._soon, self._changed = station, clock, soon, changed
        self._page: FeaturePage | None = None
        self._looked_at = -LOOKED_S
        self._chunks: deque[tuple[str, ...]] = deque()
        self._out: Future[object] | None = None
        self._failed: dict[str, str] = {}
        self._changes: list[FeatureChange] = []
        self._answers: dict[str, Reading] = {}

    @property
    def now(self) -> SheetNow:
        """What there is to show."""
        asked = frozenset(name for chunk in self._chunks for name in chunk)
        undo = self._changes[-1] if self._changes else None
        return SheetNow(asked, self._failed, self._answers, undo)

    @property
    def is_settled(self) -> bool:
        """Whether all that the tab shows was asked for."""
        return not self._chunks and self._out is None

    def look(self, page: FeaturePage | None) -> None:
        """Somebody looks at a tab, one without features for None: read what is not fresh on arrival there."""
        now = self._clock.monotonic()
        arrived = page is not self._page or now - self._looked_at > LOOKED_S
        self._page, self._looked_at = page, now
        if arrived:
            self._chunks.clear()
            self._ask_for(self._due(older_than_s=OLD_S))
        elif self.is_settled and self._unread():
            self._ask_for(self._unread())  # the machine was not known yet, or its line was down
        self.go_on()

    def read_again(self) -> None:
        """Read the whole tab now."""
        self._failed = {}
        self._chunks.clear()
        self._ask_for(self._due(older_than_s=0.0))
        self.go_on()

    def read(self, feature: Feature) -> None:
        """Read one feature now; a person has agreed to what that does (`Feature.read_hazard`)."""
        self._failed.pop(feature.id, None)
        self._submit((feature.id,), agreed=True)

    def set(self, feature: Feature, value: Value, *, undoing: bool = False) -> None:
        """Write a feature; a person was told its hazard, and agreed."""
        before = self._station.state.readings.get(feature.id)
        change = FeatureChange(feature, None if before is None else before.value, value)
        future = self._station.submit(Set(feature.id, value, YOU, agreed=True))
        future.add_done_callback(lambda done: self._soon(partial(self._have_set, done, change, undoing)))

    def undo(self) -> FeatureChange | None:
        """Put back what was set last, and return what that was; None where there is nothing."""
        change = self._changes[-1] if self._changes else None
        if change is not None and change.before is not None:
            self.set(change.feature, change.before, undoing=True)
        return change

    def _have_set(self, done: Future[object], change: FeatureChange, undoing: bool) -> None:
        name = change.feature.id
        error = None if done.cancelled() else done.exception()
        if error is None:
            self._failed.pop(name, None)
            answer = done.result()
            if not change.feature.is_readable and change.feature.kind is FeatureKind.TEXT:
                assert isinstance(answer, Reading), "the station's promise"
                self._answers[name] = answer
            if undoing:
                self._changes.pop()
            elif change.before is not None and change.feature.is_readable:
                self._changes.append(change)
            self._ask_for(self._told_with(change.feature))
            self.go_on()
        else:
            self._failed[name] = str(error)
        self._changed()

    def _told_with(self, feature: Feature) -> list[Feature]:
        """Return what else stands under the same heading: it may have changed with it."""
        return [each for each in self._features() if each.group == feature.group and _is_read_unasked(each)]

    def _features(self) -> list[Feature]:
        return [] if self._page is None else features_on(self._station.state.dish, self._page)

    def _due(self, *, older_than_s: float) -> list[Feature]:
        now, readings = self._clock.monotonic(), self._station.state.readings

        def is_due(each: Feature) -> bool:
            last: Reading | None = readings.get(each.id)
            return last is None or now - last.at > older_than_s

        return [each for each in self._features() if _is_read_unasked(each) and is_due(each)]

    def _unread(self) -> list[Feature]:
        readings = self._station.state.readings
        return [
            each for each in self._features()
            if _is_read_unasked(each) and each.id not in readings and each.id not in self._failed
        ]  # fmt: skip

    def _ask_for(self, features: Iterable[Feature]) -> None:
        """Queue them: what is cheap first, each menu once."""
        wanted = list(features)
        for cheap in (True, False):
            some = [each for each in wanted if (each.cost.lines <= SOON_LINES) is cheap]
            some.sort(key=lambda each: (each.cost.menu or "", each.id in self._station.state.readings))
            if some:
                self._chunks.append(tuple(each.id for each in some))

    def go_on(self) -> None:
        """Ask for the next, if the page is still seen and the machine may be asked."""
        if self._out is not None or not self._chunks:
            return
        if self._clock.monotonic() - self._looked_at > LOOKED_S:
            self._chunks.clear()
        elif not waits_for(self._station.state):
            self._submit(self._chunks.popleft(), agreed=False)

    def _submit(self, ids: tuple[str, ...], *, agreed: bool) -> None:
        self._out = self._station.submit(Read(ids, agreed=agreed))
        self._out.add_done_callback(lambda done: self._soon(partial(self._have_read, done, ids)))

    def _have_read(self, done: Future[object], ids: tuple[str, ...]) -> None:
        self._out = None
        error = None if done.cancelled() else done.exception()
        if isinstance(error, BirdcageError) and error.reason is Reason.MOVING:
            self._chunks.appendleft(ids)
        elif error is not None and len(ids) > 1:  # one of them is to blame: the others are told apart from it
            half = len(ids) // 2
            self._chunks.extendleft((ids[half:], ids[:half]))
            self.go_on()
        elif error is not None:
            self._failed[ids[0]] = str(error)
            self.go_on()
        else:
            readings = self._station.state.readings
            self._failed |= {each: "The dish did not tell it." for each in ids if each not in readings}
            self.go_on()
        self._changed()


def _is_read_unasked(feature: Feature) -> bool:
    return feature.is_readable and not feature.read_hazard and feature.kind is not FeatureKind.MOMENTARY
