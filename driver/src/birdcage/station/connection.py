"""Keeps the link: opens, notices silence and loss, finds the port again, and looks where the dish is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.az_el import AzEl
from birdcage.base.errors import BirdcageError, LinkError, NoReply
from birdcage.rotator.hooks import Hooks
from birdcage.station.board import Board
from birdcage.station.events import LinkChanged
from birdcage.station.look import Look
from birdcage.station.settings import StationSettings
from birdcage.station.state import Activity, Link

FIRST_RETRY_S = 0.5
LONGEST_RETRY_S = 5.0
SILENT_RETRY_S = 1.0
BUSY_S = 60.0
"""For so long a silence after a move that was not answered counts as that of a dish that is busy with it."""
NO_PORT = "Choose a port in Setup: F8 in the app, or `birdcage setup`."
CLOSE_S = 0.05
"""How long leaving may try to bring the console back to its root menu."""


class Connection:
    """The state of the link is on the board; `due` says when to try again."""

    def __init__(
        self, board: Board, antenna: BirdcageAntenna, settings: StationSettings, look: Look, hooks: Hooks,
    ) -> None:  # fmt: skip
        """`hooks` are what the machine is opened with."""
        self._board, self._antenna, self._settings, self._look = board, antenna, settings, look
        self._hooks = hooks
        self._retry_s = FIRST_RETRY_S
        self._port, self._baud = settings.port, settings.baud
        self.due: float | None = None
        """When to try to open, or to wake the silent dish; None while all is well."""
        self.on_port: Callable[[str], None] = lambda _port: None
        """Told which port is about to be opened: its dish may be held."""

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
        return self._board.state.link.state is Link.UP

    def begin(self) -> None:
        """Open as soon as the loop turns."""
        self.due = self._board.clock.monotonic()
        self.tell_opening(f"opening {self._port}")

    def tell_opening(self, detail: str) -> None:
        """Say what is being tried."""
        self._set(Link.OPENING, detail)

    def attempt(self) -> bool:
        """Try once to come up; return whether the dish answers."""
        if not self._rotator.is_open and not self._open():
            return False
        try:
            self._rotator.meet()
            self._board.change(menu=self._rotator.line.place)
            self._look.first()
            self._look.clear_up()
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
        state = self._board.state
        if state.link.state is not Link.SILENT or state.position is None or state.position_lost is not None:
            return False
        self._is_up_again()
        return True

    def _is_up_again(self) -> None:
        self._retry_s, self.due = FIRST_RETRY_S, None
        self.note_reply()
        self._set(Link.UP, f"{self._board.state.port} answers")

    def _open(self) -> bool:
        if not self._port:
            # Nothing is looked for: `Connect` begins anew, with a port.
            self.due = None
            self._set(Link.LOST, NO_PORT)
            return False
        port = self.find()
        if port is None:
            self._retry_later(Link.LOST, f"{self._port} is not there. Plug it in; birdcage keeps looking.")
            return False
        self.on_port(port)
        try:
            self._rotator.open(port, self._baud, self._board.clock, self._hooks)
        except LinkError as error:
            self._retry_later(Link.LOST, str(error), error.reason)
            return False
        self._board.change(port=port, demo=self._rotator.is_simulated)
        return True

    def find(self) -> str | None:
        """Return where the port is now; None while it is gone."""
        return self._settings.find_port(self._port)

    def use(self, port: str, baud: int | None) -> None:
        """Speak over this port at this rate from the next `begin` on; None is the firmware's own."""
        self._port, self._baud = port, baud
        self._board.change(port=port)

    def let_go(self) -> None:
        """Close the port with nothing sent, and forget what may change meanwhile."""
        self._rotator.close(0.0)
        self._forget()
        self._look.forget_survey()
        self._retry_s = FIRST_RETRY_S

    def lost(self, error: LinkError) -> None:
        """The port is gone: forget what may have changed, and look for it again."""
        self.let_go()
        self._retry_later(Link.LOST, str(error), error.reason)

    def silent(self, silence: BirdcageError) -> None:
        """The port is there, the dish does not answer, or not what was asked."""
        self._forget()
        now, link = self._board.clock.monotonic(), self._board.state.link
        self.due = now + SILENT_RETRY_S
        is_busy = link.state is Link.SILENT and link.reason == "busy" and now < link.since + BUSY_S
        if not (is_busy and silence.reason in ("silent", "echo")):
            self._set(Link.SILENT, str(silence), silence.reason)

    def _forget(self) -> None:
        self._look.forget(self._board.state.position_lost or "link")
        booting = self._board.state.activity is Activity.INITIALIZING
        self._board.change(activity=Activity.INITIALIZING if booting else Activity.UNKNOWN, menu=None)

    def note_reply(self) -> None:
        """Copy the console's own figures onto the board."""
        line = self._rotator.line
        link = self._board.state.link
        link = replace(link, last_reply=line.last_reply, round_trip_s=line.round_trip_s, stray_bytes=line.stray_bytes)
        self._board.change(link=link, menu=line.place)

    def _retry_later(self, state: Link, detail: str, reason: str = "") -> None:
        if not self._settings.reconnect:
            self.due = None
        else:
            self.due = self._board.clock.monotonic() + self._retry_s
            self._retry_s = min(self._retry_s * 2, LONGEST_RETRY_S)
        self._set(state, detail, reason)

    def _set(self, state: Link, detail: str, reason: str = "") -> None:
        at, utc = self._board.stamp()
        before = self._board.state.link
        since = before.since if before.state is state else at
        link = replace(before, state=state, since=since, detail=detail, reason=reason)
        self._board.change(link=link)
        if before.state is not state or before.detail != detail:
            self._board.tell(LinkChanged(at, utc, link))

    def close(self) -> None:
        """Give the port back."""
        self.due = None
        self._rotator.close(CLOSE_S)
        self._set(Link.CLOSED, "closed")
