"""A machine without menus, tuner, settings, homing or search: what it answers where it has nothing to answer with."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Feature, Reading, Value
from birdcage.rotator.feature_table import FeatureTable, Stamp, middle_of
from birdcage.rotator.own_settings import OwnSettings
from birdcage.rotator.raw import RawLines
from birdcage.rotator.rotator import LineStatus
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import Survey


@dataclass(slots=True)
class PlainLine:
    """A `LineStatus` whose figures its machine keeps."""

    delay_s: float = 2.0
    place: str | None = None
    is_settled: bool = True
    last_reply: float | None = None
    round_trip_s: float | None = None
    took_s: float = 0.0
    answered: int = 0
    asked: int = 0
    unanswered: int = 0
    late: int = 0
    stray_bytes: int = 0

    def unanswered_s(self) -> float:
        """No line is left open: each is waited for, or given up."""
        return 0.0

    def note(self, asked_at: float, now: float) -> None:
        """Take in that what was asked at one time was answered now."""
        self.took_s = self.round_trip_s = now - asked_at
        self.last_reply, self.answered, self.asked = now, self.answered + 1, self.asked + 1

    def note_late(self, asked_at: float, now: float) -> None:
        """Take in that what was given up, asked at one time, was answered now all the same."""
        self.round_trip_s, self.last_reply = now - asked_at, now

    def note_silence(self) -> None:
        """Take in that an answer did not come."""
        self.answered, self.asked, self.unanswered = 0, self.asked + 1, self.unanswered + 1


class PlainRotator:
    """To inherit: what is left to write are opening, meeting, looking, sending, stopping, listening and closing."""

    facts: Facts
    feature_table: FeatureTable = FeatureTable()
    """What it tells and lets be set; its facts have the same (`features=TABLE.features`)."""
    clock: Clock
    line: LineStatus
    raw: RawLines | None = None
    own_settings: OwnSettings | None = None
    is_simulated = False
    printed_deg = 0.01

    def _lacks(self, what: str) -> CommandRefused:
        return CommandRefused(f"The {self.facts.name} has no {what}. Nothing was sent.", reason=Reason.UNSUPPORTED)

    def begin(self, tell: Callable[[str], None]) -> None:
        """It is ready as soon as it is open."""

    def make_ready(self) -> None:
        """It always is."""

    def catch_up(self) -> None:
        """Nothing is left over from an earlier program."""

    def survey(self) -> Survey:
        """It tells nothing of itself."""
        return Survey()

    def is_answer(self, text: str) -> bool:  # noqa: ARG002
        """No answer comes unasked."""
        return False

    def begin_slew(self, to: Mapping[str, float]) -> None:  # noqa: ARG002
        """Each axis is sent by itself."""
        raise self._lacks("combined move")

    def slew_is_over(self) -> bool:
        """There is none."""
        return True

    def home(self, axis: str) -> None:  # noqa: ARG002
        """It knows where it is."""
        raise self._lacks("homing")

    def stow(self) -> None:
        """It does not fold."""
        raise self._lacks("stow position")

    def sweep(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:  # noqa: ARG002
        """It has none of its own."""
        raise self._lacks("sweep of its own")

    def release_motors(self, permit: Callable[[], None]) -> None:  # noqa: ARG002
        """Its motors keep their current."""
        raise self._lacks("switch for its motors")

    def engage_motors(self) -> None:
        """As above."""
        raise self._lacks("switch for its motors")

    @property
    def features(self) -> Mapping[str, Feature]:
        """What its facts have: `feature_table.features`."""
        return self.facts.features

    def read(self, ids: Iterable[str]) -> Mapping[str, Reading]:
        """Ask by `feature_table`."""
        return self.feature_table.read(self, self.facts.name, ids, self._stamp)

    def write(self, feature: str, value: Value) -> Reading:
        """Write by `feature_table`."""
        return self.feature_table.write(self, self.facts.name, feature, value, self._stamp)

    @property
    def _stamp(self) -> Stamp:
        return middle_of(self.clock, lambda: self.line.took_s)
