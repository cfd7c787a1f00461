"""Who may move the dish: the lease, and the latch of STOP."""

from __future__ import annotations

from dataclasses import replace

from birdcage.base.errors import Held, LeaseDenied, MotionRefused
from birdcage.station.board import Board
from birdcage.station.events import HeldChanged, LeaseChanged
from birdcage.station.state import HeldState


class Control:
    """The lease and HELD. `latched` is set by STOP from any thread, before anything else happens."""

    def __init__(self, board: Board) -> None:
        self._board = board
        self.latched = False

    def take(self, holder: str, *, take_over: bool = False) -> None:
        """Give the lease to `holder`. LeaseDenied if another has it, unless taken over, which is told."""
        previous = self._board.state.holder
        if previous == holder:
            return
        if previous is not None and not take_over:
            raise LeaseDenied(f"{previous} has control. Take it over explicitly, or wait until it is given back.")
        self._pass_to(holder)

    def give_back(self, holder: str) -> None:
        """Take the lease back from `holder`; nothing happens if it has none."""
        if self._board.state.holder == holder:
            self._pass_to(None)

    def admit(self, holder: str, az_deg: float | None = None, el_deg: float | None = None) -> None:
        """Let `holder` move the dish, to where it says, or raise Held, LeaseDenied or MotionRefused."""
        self.refuse(holder, az_deg, el_deg)
        self.take(holder)

    def refuse(self, holder: str, az_deg: float | None = None, el_deg: float | None = None) -> None:
        """Raise Held or MotionRefused where nobody may move the dish now; the lease stays where it is."""
        state = self._board.state
        if self.latched:
            held = state.held
            if held is not None:
                held = replace(
                    held, next_holder=holder, next_az_deg=az_deg, next_el_deg=el_deg, ignored=held.ignored + 1
                )
                self._tell_held(held)
            raise Held(
                f"STOP is latched{f' by {held.by}' if held else ''}. A person must release it before any motion."
            )
        if state.motion_refused_because is not None:
            raise MotionRefused(state.motion_refused_because, reason="settings")
        if state.fault is not None:
            raise Held(f"A fault waits to be acknowledged: {state.fault.what}.", reason="fault")

    def announce(self, holder: str, az_deg: float, el_deg: float) -> None:
        """While it is held, say who would move first after the release, and where to; it changes as time goes on."""
        held = self._board.state.held
        if held is not None:
            self._board.change(held=replace(held, next_holder=holder, next_az_deg=az_deg, next_el_deg=el_deg))

    def hold(self, by: str, reason: str) -> None:
        """Latch, and take the lease away from whoever has it."""
        self.latched = True
        at, utc = self._board.stamp()
        if self._board.state.held is None or reason == "stop":
            self._tell_held(HeldState(by, at, utc, reason))
        if self._board.state.holder is not None:
            self._pass_to(None)

    def release(self) -> None:
        """Let go of the latch. Nothing moves by it."""
        self.latched = False
        if self._board.state.held is not None:
            self._tell_held(None)

    def _tell_held(self, held: HeldState | None) -> None:
        self._board.change(held=held)
        self._board.tell(HeldChanged(*self._board.stamp(), held))

    def _pass_to(self, holder: str | None) -> None:
        previous = self._board.state.holder
        self._board.change(holder=holder)
        self._board.tell(LeaseChanged(*self._board.stamp(), holder, previous))
