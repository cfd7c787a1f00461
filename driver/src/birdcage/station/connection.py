"""Keeps the link: opens, notices silence and loss, finds the port again, and looks where the dish is."""

from __future__ import annotations

from dataclasses import replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.az_el import AzEl
from birdcage.base.errors import BirdcageError, LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.hooks import Hooks
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import LinkChanged
from birdcage.station.settings import StationSettings
from birdcage.station.signals import Signals
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.state_store import StateStore

FIRST_RETRY_S = 0.5
LONGEST_RETRY_S = 5.0
SILENT_RETRY_S = 1.0
BUSY_S = 60.0
"""For so long a silence after a move that was not answered counts as that of a dish that is busy with it."""
NO_PORT = "Choose a port in Setup: F8 in the app, or `birdcage setup`."
CLOSE_S = 0.05
"""How long leaving may try to bring the console back to its root menu."""


class Connection:
    """The state of the link is in the state; `due` says when to try again."""

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, settings: StationSettings, reader: DishReader,
        signals: Signals, hooks: Hooks,
    ) -> None:  # fmt: skip
        """`hooks` are what the machine is opened with."""
        self._store, self._antenna, self._settings, self._reader = store, antenna, settings, reader
        self._signals, self._hooks = signals, hooks
        self._retry_s = FIRST_RETRY_S
        self._port, self._baud = settings.port, settings.baud
        self.due: float | None = None
        """When to try to open, or to wake the silent dish; None while all is well."""

    @property
    def _rotator(self) -> AzEl:
        return self._antenna.rotator

    @property
    def asked_port(self) -> str:
        """The port as it was asked for; the adapter may have another name since."""
        return self._port

    @property
    def baud(self) -> int:
        """The present rate: as asked for, or the firmware's own."""
        return self._baud or self._rotator.facts.baud

    @property
    def is_up(self) -> bool:
        """Whether the dish answers."""
        return self._store.state.link.state is LinkPhase.UP

    def begin(self) -> None:
        """Open as soon as the loop turns."""
        self.due = self._store.clock.monotonic()
        self.tell_opening(f"opening {self._port}")

    def tell_opening(self, detail: str) -> None:
        """Say what is being tried."""
        self._set(LinkPhase.OPENING, detail)

    def attempt(self) -> bool:
        """Try once to come up; return whether the dish answers."""
        if not self._rotator.is_open and not self._open():
            return False
        try:
            self._rotator.meet()
            self._store.change(menu=self._rotator.line.place)
            self._reader.first()
            self._reader.clear_up()
        except LinkError as error:
            self.lost(error)
            return False
        except NoReply as silence:
            self.silent(silence)
            return False
        self._is_up_again()
        return True

    def was_answered(self) -> bool:
        """Take note, after somebody else's exchange, that a silent dish has told where it is; return whether it has."""
        state = self._store.state
        if state.link.state is not LinkPhase.SILENT or state.position is None or state.position_lost is not None:
            return False
        self._is_up_again()
        return True

    def _is_up_again(self) -> None:
        self._retry_s, self.due = FIRST_RETRY_S, None
        self.note_reply()
        self._set(LinkPhase.UP, f"{self._store.state.port} answers")

    def _open(self) -> bool:
        if not self._port:
            # Nothing is looked for: `Connect` begins anew, with a port.
            self.due = None
            self._set(LinkPhase.LOST, NO_PORT)
            return False
        port = self.find()
        if port is None:
            self._retry_later(LinkPhase.LOST, f"{self._port} is not there. Plug it in; birdcage keeps looking.")
            return False
        self._signals.port_found(port)
        try:
            self._rotator.open(port, self._baud, self._store.clock, self._hooks)
        except LinkError as error:
            self._retry_later(LinkPhase.LOST, str(error), error.reason)
            return False
        self._store.change(port=port, demo=self._rotator.is_simulated)
        return True

    def find(self) -> str | None:
        """Return where the port is now; None while it is gone."""
        return self._settings.find_port(self._port)

    def use(self, port: str, baud: int | None) -> None:
        """Speak over this port at this rate from the next `begin` on; None is the firmware's own."""
        self._port, self._baud = port, baud
        self._store.change(port=port)

    def let_go(self) -> None:
        """Close the port with nothing sent, and forget what may change meanwhile."""
        self._rotator.close(0.0)
        self._forget()
        self._reader.forget_survey()
        self._retry_s = FIRST_RETRY_S

    def lost(self, error: LinkError) -> None:
        """The port is gone: forget what may have changed, and look for it again."""
        self.let_go()
        self._retry_later(LinkPhase.LOST, str(error), error.reason)

    def silent(self, silence: BirdcageError) -> None:
        """The port is there, the dish does not answer, or not what was asked."""
        if self._rotator.is_open:
            self.note_reply()  # that one was lost while the dish answered; what is tried from now on does not count
        self._signals.silent(silence.reason)
        self._forget()
        now, link = self._store.clock.monotonic(), self._store.state.link
        self.due = now + SILENT_RETRY_S
        is_busy = link.state is LinkPhase.SILENT and link.reason is Reason.BUSY and now < link.since + BUSY_S
        if not (is_busy and silence.reason in (Reason.SILENT, Reason.ECHO)):
            self._set(LinkPhase.SILENT, str(silence), silence.reason)

    def _forget(self) -> None:
        self._reader.forget(self._store.state.position_lost or Reason.LINK)
        booting = self._store.state.activity is Activity.INITIALIZING
        self._store.change(activity=Activity.INITIALIZING if booting else Activity.UNKNOWN, menu=None)

    def note_reply(self) -> None:
        """Copy the console's own figures into the state."""
        line, state = self._rotator.line, self._store.state
        link = state.link
        told = (
            line.last_reply, line.round_trip_s, line.stray_bytes, line.asked, line.unanswered, line.late, line.place,
        )  # fmt: skip
        if told != (
            link.last_reply, link.round_trip_s, link.stray_bytes, link.asked, link.unanswered, link.late, state.menu,
        ):  # fmt: skip
            link = replace(
                link, last_reply=told[0], round_trip_s=told[1], stray_bytes=told[2], asked=told[3], unanswered=told[4],
                late=told[5],
            )  # fmt: skip
            self._store.change(link=link, menu=line.place)

    def _retry_later(self, state: LinkPhase, detail: str, reason: Reason | None = None) -> None:
        if not self._settings.reconnect:
            self.due = None
        else:
            self.due = self._store.clock.monotonic() + self._retry_s
            self._retry_s = min(self._retry_s * 2, LONGEST_RETRY_S)
        self._set(state, detail, reason)

    def _set(self, state: LinkPhase, detail: str, reason: Reason | None = None) -> None:
        at, utc = self._store.stamp()
        before = self._store.state.link
        since = before.since if before.state is state else at
        link = replace(before, state=state, since=since, detail=detail, reason=reason)
        self._store.change(link=link)
        if before.state is not state or before.detail != detail:
            self._store.tell(LinkChanged(at, utc, link))

    def close(self) -> None:
        """Give the port back."""
        self.due = None
        self._rotator.close(CLOSE_S)
        self._set(LinkPhase.CLOSED, "closed")
