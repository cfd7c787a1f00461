"""The interface of any machine that points something. Nothing above knows more of it than this and its facts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Protocol

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Feature, Reading, Value
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopOrder
from birdcage.rotator.own_settings import OwnSettings
from birdcage.rotator.raw import RawLines
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import Look, Survey, Taken


class LineStatus(Protocol):
    """How the line to a machine fares. Any thread; sends nothing."""

    @property
    def place(self) -> str | None:
        """Where its console is (a menu); None where that is not known, or there is no such thing."""

    @property
    def is_settled(self) -> bool:
        """Whether it may be asked for something else at once: else it would first have to wait for a quiet line."""

    @property
    def last_reply(self) -> float | None:
        """When something that made sense last came, in monotonic seconds."""

    @property
    def round_trip_s(self) -> float | None:
        """How long the last short exchange took, from its first byte out to its answer's last."""

    @property
    def took_s(self) -> float:
        """The same of the last exchange of any length."""

    @property
    def answered(self) -> int:
        """How many exchanges in a row, up to the last one, were answered in time."""

    @property
    def asked(self) -> int:
        """How many lines were sent that are to be answered, since it was opened; what STOP writes does not count."""

    @property
    def unanswered(self) -> int:
        """How many of them were given up: no answer came in time, or none that could be read."""

    @property
    def late(self) -> int:
        """How many of a stream of targets were not answered as soon as the stream could wait."""

    @property
    def stray_bytes(self) -> int:
        """How many bytes came that nothing asked for, or that could not be read."""

    @property
    def delay_s(self) -> float:
        """The longest that an answer may be on its way."""

    def unanswered_s(self) -> float:
        """Return for how long the oldest line has had no answer: 0 where none is due, infinite where one is missing."""


class Rotator(Protocol):
    """One machine. Its owner's thread, except for `stop_now`.

    Angles are the machine's own degrees, by the names of its axes (`Facts.axes`). Whatever talks raises LinkError when
    the line is gone, NoReply when the machine does not answer in time, and CommandRefused when it answers with an
    error, or (`unsupported`) where it cannot do that.
    """

    facts: Facts
    """What is known of all that are like it."""
    raw: RawLines | None
    """The line as a person may use it; None where there is no such thing."""
    own_settings: OwnSettings | None
    """The settings that it keeps in its own memory; None where there is no such thing, or no command is known."""

    @property
    def is_open(self) -> bool:
        """Whether there is a line to it."""

    @property
    def is_simulated(self) -> bool:
        """Whether what answers is a simulator."""

    @property
    def clock(self) -> Clock:
        """The clock of the line; LinkError while there is none."""

    @property
    def line(self) -> LineStatus:
        """How the line fares; LinkError while there is none."""

    @property
    def printed_deg(self) -> float:
        """How fine the angles are that it tells, as its last reading showed."""

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """Open a line to it; None is its own rate. Sends nothing. LinkError says what is wrong."""

    def close(self, within_s: float) -> None:
        """Leave it as it should be found, if that can be done safely within a time (0: send nothing), and let go.

        Never raises for a line that is gone.
        """

    def begin(self, tell: Callable[[str], None]) -> None:
        """Wait for the end of its start, and make it ready. `tell` hears how it goes."""

    def meet(self) -> None:
        """Find out whether it answers. NoReply says what came instead."""

    def make_ready(self) -> None:
        """Be where motions, and what stops them, are understood; nothing is sent when it is so already."""

    def catch_up(self) -> None:
        """Account for what an earlier program may have sent, to make it `is_settled` if that can be."""

    def survey(self) -> Survey:
        """Read what it tells of itself; where it tells nothing, nothing is sent."""

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Look:
        """Ask once where it is. PositionUnknown where it does not know; UnreadablePosition for what is no position.

        In a `hurry`, within a stream of targets: NoReply (`late`) where waiting would hold that up. `busy_s`: how long
        a move may keep it from answering.
        """

    def send(self, to: Mapping[str, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:
        """Send the axes that are to change, and only those; returns when that was answered.

        The gate has let it through. More than one at a time only where `Facts.sends_together`, or by a mapping.

        In a `hurry`, as one of a stream of which each makes the one before it void: NoReply (`late`) when the answer
        was not there as soon as others were, and it may have been taken or not. `busy_s`: how long a motor may still
        run, and a machine that waits for it not answer.
        """

    def begin_slew(self, to: Mapping[str, float]) -> None:
        """Send all axes in one go, and return as soon as that is sent.

        An axis whose angle is not known is missing. Until `slew_is_over` nothing else may be sent, but what ends it, if
        anything does (`Facts.stop_ladder`). Stopped (`half_sent`): STOP came when a part of it had gone out.
        """

    def slew_is_over(self) -> bool:
        """Return whether it has said so since `begin_slew`. Sends nothing, and does not wait."""

    def stop_now(self, order: StopOrder) -> None:
        """Write what stops it at once, from any thread, also in mid-exchange; `settle` hears the answer."""

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:
        """Wait for the answers to all that `stop_now` wrote, and return of each whether it was refused.

        Empty when none was due. NoReply when not all came.
        """

    def listen(self, until: float) -> None:
        """Take in what comes unasked, until a monotonic time at the latest."""

    def is_answer(self, text: str) -> bool:
        """Return whether an unasked line is an answer that comes late, or a piece of one. Sends nothing."""

    def home(self, axis: str) -> None:
        """Find the reference of an axis; returns when it has."""

    def stow(self) -> None:
        """Fold flat, as the machine does it."""

    def sweep(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:
        """Sweep an axis as the machine does it (`Facts.sweep`); returns when it is over.

        `hear` is given each reading as it comes, None for a line that can't be read. PositionUnknown, and nothing is
        sent, where an axis is not homed; NoReply when it stops telling.
        """

    def release_motors(self, permit: Callable[[], None]) -> None:
        """Take the current off the motors; `permit` instead of the owner's own, as STOP may do this too."""

    def engage_motors(self) -> None:
        """Put the current back on the motors."""

    @property
    def features(self) -> Mapping[str, Feature]:
        """What it tells and lets be set besides its position, by id: `Facts.features`."""

    def read(self, ids: Iterable[str]) -> Mapping[str, Reading]:
        """Read some features; what was not told is left out, and what the same answers told of others is not.

        Nothing is sent where one of them can't be read.
        """

    def write(self, feature: str, value: Value) -> Reading:
        """Write a feature, and return what was read back. OutOfRange (nothing sent) for a value beyond its range."""
