"""The taxonomy of what can go wrong.

    BirdcageError
      ConfigError        a setting cannot be read or is not allowed
      StoreError         a database cannot be opened or written
      LinkError          the port: missing, busy, forbidden, lost, broken
      NoReply            the port is there, the dish did not answer in time
      CommandRefused     the firmware answered with an error
        OutOfRange       (also a ValueError) a value that a feature of the dish can't be set to
      MotionRefused      a limit, or missing knowledge, forbids the motion
        BelowFloor       (also a ValueError) the elevation floor
        PositionUnknown  the axis was not read, or not homed
      NotTaken           the answer to a move was not known, and the dish stood still
      Held               STOP is latched
      LeaseDenied        somebody else has control
      ConfirmationNeeded a raw line that may do harm was not confirmed
      Superseded         a newer target replaced this one
      Stopped            STOP or a loss of the link ended it
      Cancelled          the person who asked took it back
      BadMessage         what another program sent is not in the JSON form of requests and events
      WrongThread        a dish that a station owns was called from another thread

Each carries `reason`, a word that a program can test, and a sentence for a person: what happened, what it means for
the dish, what to do.
"""

from __future__ import annotations

from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.base.trouble import MotorTrouble


class BirdcageError(Exception):
    """Base of all. `reason` is a stable word; the message is for people, whatever it quotes (`base.text`)."""

    reason: Reason = Reason.ERROR

    def __init__(self, message: str, *, reason: Reason | None = None) -> None:
        super().__init__(clean(message))
        if reason is not None:
            self.reason = reason


class ConfigError(BirdcageError):
    """A setting cannot be read or is not allowed; the message names file, key and remedy."""

    reason = Reason.CONFIG


class StoreError(BirdcageError):
    """A database of ours. Reasons: newer, damaged, failed."""

    reason = Reason.FAILED


class LinkError(BirdcageError):
    """The port. Reasons: missing, busy, permission, unsupported, lost, failed."""

    reason = Reason.FAILED


class NoReply(BirdcageError):
    """The dish did not answer within its deadline. Reasons: silent, garbage, echo, blocked."""

    reason = Reason.SILENT


class CommandRefused(BirdcageError):
    """The firmware answered with an error: nothing was done. Reasons: unknown_command, bad_parameter, wrong_menu.

    `trouble` is what that answer says of a motor; None if it says nothing of one.
    """

    reason = Reason.UNKNOWN_COMMAND

    def __init__(self, message: str, *, reason: Reason | None = None, trouble: MotorTrouble | None = None) -> None:
        super().__init__(message, reason=reason)
        self.trouble = trouble


class OutOfRange(CommandRefused, ValueError):
    """A value lies outside the range of what it was meant for: nothing was sent."""

    reason = Reason.OUT_OF_RANGE


class MotionRefused(BirdcageError):
    """A motion that was not sent. Reasons: not_a_number, az_limit, el_limit, wrap, sector, floor, unknown, unhomed.

    `limit_deg` is the limit that it would break and `by_deg` by how much; None if no number applies.
    """

    reason = Reason.LIMIT

    def __init__(
        self,
        message: str,
        *,
        reason: Reason | None = None,
        limit_deg: float | None = None,
        by_deg: float | None = None,
    ) -> None:
        super().__init__(message, reason=reason)
        self.limit_deg = limit_deg
        self.by_deg = by_deg


class BelowFloor(MotionRefused, ValueError):
    """The target lies below the elevation floor."""

    reason = Reason.FLOOR


class PositionUnknown(MotionRefused):
    """The position of the dish is unknown. Reasons: unread, unhomed, unsynced, unreadable, released."""

    reason = Reason.UNREAD


class NotTaken(BirdcageError):
    """The dish answered a move with nothing, or with what is not known, and stands where it stood."""

    reason = Reason.NOT_TAKEN


class Held(BirdcageError):
    """STOP is latched: the dish stays until a person releases it."""

    reason = Reason.HELD


class LeaseDenied(BirdcageError):
    """Somebody else has control; the message names the holder."""

    reason = Reason.LEASE


class ConfirmationNeeded(BirdcageError):
    """A raw console line that is not harmless was sent without a person's word; the message names the consequence."""

    reason = Reason.CONFIRM


class Superseded(BirdcageError):
    """A newer target replaced this one before it was reached."""

    reason = Reason.SUPERSEDED


class Stopped(BirdcageError):
    """The motion was ended before it arrived: STOP, a lost link, a fault or the end of the station."""

    reason = Reason.STOPPED


class Cancelled(BirdcageError):
    """The person who asked for it took it back."""

    reason = Reason.CANCELLED


class BadMessage(BirdcageError):
    """JSON that is no request, event or answer of ours; the message names the field, and what belongs there."""

    reason = Reason.BAD_MESSAGE


class WrongThread(BirdcageError):
    """A station owns this antenna: ask the station instead."""

    reason = Reason.WRONG_THREAD
