"""What one client wishes: from `P` to what became of it."""

from __future__ import annotations

import logging
from concurrent.futures import Future
from contextlib import suppress
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, Stopped, Superseded
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.rotctld.client_pursuit import ClientPursuit
from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.rotctld.wish_smoother import WishSmoother
from birdcage.station.requests import Follow, Goto, ReportIgnored
from birdcage.station.state import Activity, LinkPhase

if TYPE_CHECKING:
    from birdcage.rotctld.shared_dish import SharedDish

log = logging.getLogger("birdcage.rotctld")

REPORT_S = 60.0
"""How often it is told of one client at most that its wishes are not carried out."""
SHUT_OUT = "A person has its wishes ignored."
READ_ONLY = "This server is read-only: clients look, and move nothing."


class ClientWishes:
    """Of one client: the newest counts. It is sent, waits for a dish out of sight, or is ignored and counted."""

    def __init__(self, shared: SharedDish, holder: str) -> None:
        """`holder`: the name by which the client holds control."""
        self._shared, self._station, self._options, self._holder = shared, shared.station, shared.options, holder
        self.wish: WishedDirection | None = None
        """What it asked for last; None if it asked for nothing yet, or has taken that back."""
        self.at: float | None = None
        """When that was; monotonic seconds."""
        self._asked: Future[object] | None = None
        """What became of the last wish that went to the station."""
        self._asked_for: WishedDirection | None = None
        self._aim: WishedDirection | None = None
        """Where the dish was sent for it: there, or ahead of it."""
        self._smoother = WishSmoother(
            self._station, holder, "off" if self._options.leapfrog else self._options.smoother
        )
        self.pursuit = ClientPursuit(self._station, holder, shared.recogniser)
        """Of the satellite that it follows."""
        self.waits = False
        """Whether the wish is to be sent once the dish is back in sight."""
        self._refused_since: float | None = None
        """Since when the dish is held for a lost link that this client's wish was seen not to end."""
        self._report_at = 0.0
        """When it may be told next that its wishes are ignored."""
        self.shut_out = False
        """Whether a person has its wishes ignored."""
        self.ignored = 0
        """How many wishes were not carried out."""
        self.why = ""
        """Why the last of them was not; empty while they are carried out."""

    @property
    def motion(self) -> Future[object] | None:
        """The end of the motion that it has asked for; None where none is under way."""
        return None if self._asked is None or self._asked.done() else self._asked

    @property
    def has_control(self) -> bool:
        """Whether this client has control of the dish."""
        return self._station.state.holder == self._holder

    def take(self, wish: WishedDirection) -> None:
        """Take a wish. EIO or ETIMEOUT while the dish is out of sight for longer than is held over."""
        now = self._station.clock.monotonic()
        self.hear_outcome()
        self.wish, self.at = wish, now
        self._shared.idle.wished()
        self.waits = False
        if self._options.read_only:
            self._ignore(READ_ONLY)
            return
        self._shared.seen.look(self._station.state, now)
        if self._station.state.link.state is not LinkPhase.UP:
            if not self._shared.seen.is_held_over(now):
                raise self._shared.seen.error(self._station.state)
            self.waits = True
            return
        if self._is_settling:
            self.waits = True
            return
        if self._ends_smoothing():
            self._smoother.end()
            self.pursuit.stop()
            self._ask(wish, wish)
        elif self.pursuit.covers(wish, now):
            self.why = ""
        else:
            self._ask(wish, self._smoother.take(wish, now))

    def end_stream(self) -> None:
        """Take the next wish as it is: it has nothing to do with those before."""
        self._smoother.end()
        self.pursuit.end()

    def _ends_smoothing(self) -> bool:
        """Whether a wish is at most carried out as it is: the dish is not, or not surely, this client's to move."""
        return self.waits or bool(self.obstacle(resumes=False))

    def _ask(self, wish: WishedDirection, aim: WishedDirection) -> None:
        """Send the dish to `aim` for a wish, unless something is in its way, or it is on its way there already."""
        if why := self.obstacle():
            self._ignore(why)
            return
        self._send(wish, aim, self._options.gap_s if self._options.gap == "hold" else 0.0)

    def _send(self, wish: WishedDirection, aim: WishedDirection, gap_s: float) -> None:
        asked = self._asked
        # A leap-frogged dish stands beyond its target: the same wish again brings it there.
        again = not self._options.leapfrog and aim.is_as(self._aim)
        if asked is not None and again and self._is_in_force(asked):
            return
        if asked is not None:
            asked.cancel()  # where it was not served yet, the newer wish takes its place
        name = self._holder
        self._shared.take_from_departed()
        request: Goto | Follow
        if self._options.leapfrog:
            request = Follow(
                aim.az_deg, aim.el_deg, name, leapfrog=True, clamp=True, asked=False, resume_within_s=gap_s
            )
        else:
            request = Goto(aim.az_deg, aim.el_deg, name, clamp=True, asked=False, resume_within_s=gap_s)
        self._asked, self._asked_for, self._aim, self.why = self._station.submit(request), wish, aim, ""

    def _is_in_force(self, asked: Future[object]) -> bool:
        """Return whether the dish goes, or has gone, where it was asked to, and nothing came between."""
        if not asked.done():
            return True
        return self.has_control and not asked.cancelled() and asked.exception() is None

    def obstacle(self, *, resumes: bool = True) -> str:
        """Return why no wish of this client's is carried out now, as a sentence; empty if nothing is known.

        `resumes`: whether the wish may let go of HELD after a short loss of the link.
        """
        state = self._station.state
        if self.shut_out:
            return SHUT_OUT
        if state.holder not in (None, self._holder, self._shared.idle.holder, self._shared.departed_holder):
            return f"{state.holder} has control of the dish."
        if state.held is not None:
            lost = resumes and state.held.reason is HeldReason.LINK and self._options.gap == "hold"
            return "" if lost and state.held.since != self._refused_since else state.held.sentence
        if state.fault is not None:
            return f"{state.fault.what}. A person has to acknowledge that first."
        return state.motion_refused_because or ""

    @property
    def _is_settling(self) -> bool:
        """Whether the link is back, and the dish was not yet seen at rest since."""
        state = self._station.state
        lost = state.held is not None and state.held.reason is HeldReason.LINK
        return lost and state.activity in (Activity.UNKNOWN, Activity.INITIALIZING)

    def _ignore(self, why: str) -> None:
        """Count a wish that is not carried out. ERJCTED where the server is strict."""
        self.note_ignored(why)
        if self._options.strict:
            raise RotctldError(Rprt.ERJCTED, why)

    def note_ignored(self, why: str) -> None:
        """Count a wish that is not carried out, and say why."""
        now = self._station.clock.monotonic()
        if why != self.why and now >= self._report_at:
            self._report_at = now + REPORT_S
            log.info("%s is ignored: %s", self._holder, why)
            self._station.submit(ReportIgnored(self._holder, why))
        self.ignored, self.why = self.ignored + 1, why

    def hear_outcome(self) -> None:
        """Take in what became of the last wish, once that is known."""
        asked, wish = self._asked, self._asked_for
        if asked is None or not asked.done():
            return
        error = None if asked.cancelled() else asked.exception()
        if error is None:
            return
        self._asked = self._asked_for = None
        self._smoother.end()
        if isinstance(error, Stopped) and error.reason is Reason.LINK:
            self.waits = self.wish is not None and self.wish.is_as(wish)
        elif isinstance(error, BirdcageError) and not isinstance(error, Stopped | Superseded):
            held = self._station.state.held
            self._refused_since = None if held is None else held.since
            self.note_ignored(str(error))

    def forget(self) -> None:
        """Take the wish back: what was sent already goes on."""
        self.hear_outcome()
        self._smoother.forget()
        self.pursuit.forget()
        self.wish = self.at = None
        self.waits = False
        self.why = ""
        if self._asked is not None:
            self._asked.cancel()
            self._asked = self._asked_for = None

    def tick(self, now: float) -> None:
        """Send what is due between wishes; and the one that waits for the dish, once that was seen at rest again."""
        self.hear_outcome()
        if self.pursuit.tick(now) and self.wish is not None:
            with suppress(RotctldError):  # no client waits for an answer; the view tells
                self._ask(self.wish, self.wish)
        if self.has_control and not self._ends_smoothing() and self.pursuit.take_up():
            self._smoother.end()
            self._asked = self._asked_for = self._aim = None
        self._go_on(now)
        if not self.waits or self.wish is None:
            return
        if self._station.state.link.state is not LinkPhase.UP:
            self.waits = self._shared.seen.is_held_over(now)
        elif not self._is_settling:
            self.waits = False
            with suppress(RotctldError):  # its client has its answer already; the view tells
                self._ask(self.wish, self.wish)

    def _go_on(self, now: float) -> None:
        """Send what is due between two wishes, while the dish is this client's to move."""
        if self._smoother.due is None:
            return
        lost = self._station.state.link.state is not LinkPhase.UP
        if self.wish is None or lost or not self.has_control or self._ends_smoothing():
            self._smoother.end()
        elif aim := self._smoother.tick(now):
            self._send(self.wish, aim, 0.0)

    @property
    def due(self) -> float | None:
        """When the dish gets a target between two wishes, in monotonic seconds; None while none waits."""
        return self._smoother.due

    @property
    def lead_s(self) -> float | None:
        """By how much the dish leads the wishes, in seconds; None while they are sent as they are."""
        return self._smoother.lead_s
