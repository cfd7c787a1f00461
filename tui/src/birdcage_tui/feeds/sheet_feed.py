"""Reads what a tab of the System page shows, as soon as somebody looks at it, and sets what is changed there."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future
from functools import partial

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.feature import Feature, FeatureKind, FeaturePage, Reading, Value
from birdcage.station.access import FaceStation
from birdcage.station.requests import Read, Set

from birdcage_tui.feeds.dish_seen import DishSeen
from birdcage_tui.shown.system_sheet import (
    OLD_S,
    FeatureChange,
    SheetNow,
    features_on,
    waits_for,
    words_of_value,
)
from birdcage_tui.shown.view import YOU

LOOKED_S = 3.0
"""A page that was not drawn for so long is hidden: what has not been asked for by then is not."""
SOON_LINES = 4
"""What takes more lines than this is read after the rest."""
AGAIN_S = 3.0
"""So long after a failure that is of the line, and of no feature, the same is asked for once more."""
Chunk = tuple[tuple[str, ...], bool]
"""Features that are asked for in one question, and whether a person has agreed to what that does."""


class SheetFeed:
    """For the app's thread. One question at a time: the station may be asked for something else in between."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Callable[[], None]], object],
        changed: Callable[[], object], say: Callable[[str], object],
    ) -> None:  # fmt: skip
        """`say` hears what came of a value that was set."""
        self._station, self._clock, self._soon, self._changed = station, clock, soon, changed
        self._say, self._seen = say, DishSeen()
        self._page: FeaturePage | None = None
        self._looked_at = -LOOKED_S
        self._chunks: deque[Chunk] = deque()
        self._out: Chunk | None = None
        self._not_before = -math.inf
        self._failed: dict[str, str] = {}
        self._changes: list[FeatureChange] = []
        self._sets = False
        self._answers: dict[str, Reading] = {}

    @property
    def now(self) -> SheetNow:
        """What there is to show."""
        asked = frozenset(name for ids, _ in (*self._chunks, *((self._out,) if self._out else ())) for name in ids)
        undo = self._changes[-1] if self._changes else None
        return SheetNow(asked, dict(self._failed), dict(self._answers), undo)

    @property
    def is_settled(self) -> bool:
        """Whether all that the tab shows was asked for."""
        return not self._chunks and self._out is None

    @property
    def epoch(self) -> int:
        """Counts the dishes, and their restarts: a question that was asked of one is not answered for another."""
        return self._seen.epoch

    def notice(self) -> None:
        """Drop what was read of a dish, and set on it, once it is another or has started anew."""
        if self._seen.is_another(self._station.state):
            self._chunks.clear()
            self._out, self._sets = None, False
            self._failed, self._changes, self._answers = {}, [], {}

    def look(self, page: FeaturePage | None) -> None:
        """Somebody looks at a tab, one without features for None: read what is not fresh on arrival there."""
        now = self._clock.monotonic()
        self.notice()
        arrived = page is not self._page or now - self._looked_at > LOOKED_S
        self._page, self._looked_at = page, now
        if arrived:
            self._chunks.clear()
            self._ask_for(self._due(older_than_s=OLD_S))
        elif self.is_settled and (unread := self._unread()):
            self._ask_for(unread)  # the machine was not known yet, or its line was down
        self.go_on()

    def read_again(self) -> None:
        """Read the whole tab now."""
        self._failed = {}
        self._chunks.clear()
        self._ask_for(self._due(older_than_s=0.0))
        self.go_on()

    def read(self, feature: Feature) -> None:
        """Read one feature now, or not at all; a person has agreed to what that does (`Feature.read_hazard`)."""
        if why := waits_for(self._station.state):
            self._say(why)
            return
        self._failed.pop(feature.id, None)
        self._chunks.appendleft(((feature.id,), True))
        self.go_on()

    def set(self, feature: Feature, value: Value, epoch: int) -> None:
        """Write a feature of the dish of that `epoch`; a person was told its hazard, and agreed."""
        before = self._station.state.readings.get(feature.id)
        self._submit_set(FeatureChange(feature, None if before is None else before.value, value), None, epoch)

    def hold_at(self, feature: Feature, value: float) -> None:
        """Keep at which value a motor is run while its key is held. Sends nothing."""
        self._answers[feature.id] = Reading(value, feature.unit, self._clock.monotonic(), self._clock.utc())
        self._changed()

    def undo(self, change: FeatureChange, epoch: int) -> None:
        """Put back what was set last; a person was told its hazard, and agreed."""
        if change in self._changes and change.before is not None:
            self._submit_set(FeatureChange(change.feature, change.after, change.before), change, epoch)

    def _submit_set(self, change: FeatureChange, undoes: FeatureChange | None, epoch: int) -> None:
        self.notice()
        if epoch != self.epoch:
            self._say("The dish is another one now, or has started anew. Nothing was set.")
        elif self._sets:
            self._say("The dish is still setting the last value. Try again in a moment.")
        else:
            self._sets = True
            future = self._station.submit(Set(change.feature.id, change.after, YOU, agreed=True))
            future.add_done_callback(lambda done: self._soon(partial(self._have_set, done, change, undoes, epoch)))

    def _have_set(
        self, done: Future[object], change: FeatureChange, undoes: FeatureChange | None, epoch: int
    ) -> None:  # fmt: skip
        if epoch != self.epoch:
            return
        self._sets = False
        feature = change.feature
        error = None if done.cancelled() else done.exception()
        if done.cancelled() or error is not None:
            if isinstance(error, NoReply | LinkError):  # its answer is missing: what holds now has to be read
                self._say(f"{feature.label} may have been set. {error}")
                self._ask_for([feature, *self._told_with(feature)] if feature.is_readable else [])
                self.go_on()
            else:
                self._say(f"{feature.label} was not set. {error or ''}".strip())
            return
        answer = done.result()
        assert isinstance(answer, Reading), "the station's promise"
        if undoes is not None:
            if undoes in self._changes:
                self._changes.remove(undoes)
        elif change.before is not None and feature.is_readable:
            self._changes.append(change)
        if feature.kind is FeatureKind.MOMENTARY:
            self._say(f"{feature.label}: done.")
        elif not feature.is_readable:
            self._answers[feature.id] = answer
            self._say(f"{feature.label}: {answer.value}")
        else:
            back = "" if undoes is not None or change.before is None else " u puts back the value from before."
            self._say(f"{feature.label}: {words_of_value(feature, answer.value)}.{back}")
        self._ask_for(self._told_with(feature))
        self.go_on()
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
                self._chunks.append((tuple(each.id for each in some), False))

    def go_on(self) -> None:
        """Ask for the next, if the page is still seen and the machine may be asked."""
        now = self._clock.monotonic()
        if self._out is not None or not self._chunks or now < self._not_before:
            return
        if now - self._looked_at > LOOKED_S:
            self._chunks.clear()
        elif not waits_for(self._station.state):
            self._out = ids, agreed = self._chunks.popleft()
            future = self._station.submit(Read(ids, agreed=agreed))
            epoch = self.epoch
            future.add_done_callback(lambda done: self._soon(partial(self._have_read, done, (ids, agreed), epoch)))

    def _have_read(self, done: Future[object], chunk: Chunk, epoch: int) -> None:
        if epoch != self.epoch:
            return
        self._out = None
        ids, agreed = chunk
        error = None if done.cancelled() else done.exception()
        if error is None and not done.cancelled():
            told = done.result()
            assert isinstance(told, Mapping), "the station's promise"
            for each in ids:
                self._failed.pop(each, None)
                if each not in told:
                    self._failed[each] = "The dish did not tell it."
        elif agreed:  # a person has agreed to one reading, and not to more of them
            self._failed[ids[0]] = str(error or "It was not read.")
            self._say(str(error or "It was not read."))
        elif not set(ids) <= {each.id for each in self._features()}:
            pass  # of a tab that was left
        elif not _is_of_a_feature(error):
            self._chunks.appendleft(chunk)
            self._not_before = self._clock.monotonic() + AGAIN_S
        elif len(ids) > 1:  # one of them is to blame: the others are told apart from it
            half = len(ids) // 2
            self._chunks.extendleft(((ids[half:], agreed), (ids[:half], agreed)))
        else:
            self._failed[ids[0]] = str(error)
        self.go_on()
        self._changed()


def _is_of_a_feature(error: BaseException | None) -> bool:
    """Return whether a question failed because of what it asked for, and not of the line or of who has control."""
    return isinstance(error, CommandRefused) or (isinstance(error, NoReply) and error.reason is Reason.GARBAGE)


def _is_read_unasked(feature: Feature) -> bool:
    return feature.is_readable and not feature.read_hazard and feature.kind is not FeatureKind.MOMENTARY
