"""Who may move the dish: the lease, and the latch of STOP."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta

from birdcage.base.errors import Held, LeaseDenied, MotionRefused
from birdcage.base.held import HeldNote, HeldReason
from birdcage.base.reason import Reason
from birdcage.station.events import HeldChanged, LeaseChanged
from birdcage.station.held_keeper import HeldKeeper
from birdcage.station.signals import Signals
from birdcage.station.state import HeldState
from birdcage.station.state_store import StateStore


class Control:
    """The lease and HELD. `latched` is set by STOP from any thread, before anything else happens."""

    def __init__(self, store: StateStore, signals: Signals, keeper: HeldKeeper | None = None) -> None:
        """`keeper` keeps HELD for the programs that come after; None if nothing lasts beyond this one."""
        self._store, self._keeper = store, keeper
        self.latched = False
        self.despite_fault = ""
        """Who may move the dish though a fault waits: to home it after that. Empty: no holder."""
        self.due: float | None = None
        """When the holder's control ends by itself, in monotonic seconds."""
        signals.port_found.connect(self.meet)
        if keeper is not None:
            keeper.on_trouble = lambda sentence: store.change(held_trouble=sentence)

    def take(self, holder: str, *, take_over: bool = False) -> None:
        """Give the lease to `holder`. LeaseDenied if another has it, unless taken over, which is told."""
        self.may_take(holder, take_over=take_over)
        if self._store.state.holder != holder:
            self._pass_to(holder)

    def may_take(self, holder: str, *, take_over: bool = False) -> None:
        """Raise LeaseDenied where `take` would; the lease stays where it is."""
        previous = self._store.state.holder
        if previous not in (None, holder) and not take_over:
            raise LeaseDenied(f"{previous} has control. Take control, or wait until it is free.")

    def end_after(self, for_s: float | None) -> None:
        """Let the present holder have control for so long, and no longer; None: until it is given back."""
        at, utc = self._store.stamp()
        self.due = None if for_s is None else at + for_s / self._store.clock.rate
        self._store.change(holder_until=None if for_s is None else utc + timedelta(seconds=for_s))

    def tick(self) -> None:
        """The time of the holder is over."""
        self._pass_to(None)

    def hand_back(self, holder: str, previous: str | None) -> None:
        """Give the lease that `holder` has taken back to its previous holder, if there was one."""
        if previous is None:
            self.give_back(holder)
        else:
            self.take(previous, take_over=True)

    def give_back(self, holder: str) -> None:
        """Take the lease back from `holder`; nothing happens if it has none."""
        if self._store.state.holder == holder:
            self._pass_to(None)

    def admit(self, holder: str, az_deg: float | None = None, el_deg: float | None = None) -> None:
        """Let `holder` move the dish, to where it says, or raise Held, LeaseDenied or MotionRefused."""
        self.refuse(holder, az_deg, el_deg)
        self.take(holder)

    def refuse(self, holder: str, az_deg: float | None = None, el_deg: float | None = None) -> None:
        """Raise Held or MotionRefused where the dish may not be moved now; the lease stays where it is."""
        state = self._store.state
        if self.latched:
            held = state.held
            if held is not None:
                held = replace(
                    held, next_holder=holder, next_az_deg=az_deg, next_el_deg=el_deg, ignored=held.ignored + 1
                )
                self._tell_held(held)
            raise Held(
                f"{'HELD.' if held is None else held.sentence} Nothing was sent: Enter in the app or "
                "`birdcage release` lets it move again."
            )
        if state.motion_refused_because is not None:
            raise MotionRefused(state.motion_refused_because, reason=Reason.SETTINGS)
        if state.fault is not None and holder != self.despite_fault:
            raise Held(f"Acknowledge the fault first: {state.fault.what}.", reason=Reason.FAULT)

    def announce(self, holder: str, az_deg: float, el_deg: float) -> None:
        """While it is held, say who would move first after the release, and where to; it changes as time goes on."""
        held = self._store.state.held
        if held is not None:
            self._store.change(held=replace(held, next_holder=holder, next_az_deg=az_deg, next_el_deg=el_deg))

    def meet(self, port: str) -> None:
        """Take in which dish it is, and hold it if an earlier program did and it was not released since."""
        note = None if self._keeper is None else self._keeper.meet(port)
        if note is None or self.latched:
            return
        self.latched = True
        at, _ = self._store.stamp()
        self._tell_held(
            HeldState(note.by, at, note.utc, note.reason, earlier=True, damage=note.damage, detail=note.detail)
        )

    def hold(self, by: str, reason: HeldReason, *, detail: str = "", keep: bool = True) -> None:
        """Latch, and take the lease away from whoever has it. `keep`: also for the programs that come after."""
        self.latched = True
        at, utc = self._store.stamp()
        if self._store.state.held is None or reason is HeldReason.STOP:
            self._tell_held(HeldState(by, at, utc, reason, detail=detail))
            if keep:
                self.keep(by, utc, reason, detail)
        if self._store.state.holder is not None:
            self._pass_to(None)

    def keep(self, by: str, utc: datetime, reason: HeldReason, detail: str = "") -> None:
        """Let HELD outlive this program. Any thread; never waits for the disk."""
        if self._keeper is not None:
            self._keeper.latch(HeldNote(by, utc, reason, self._store.state.port, detail=detail))

    def expect_another_dish(self) -> None:
        """What answers next may be another dish. HELD holds there too; a release then leaves the first one held."""
        if self._keeper is not None:
            self._keeper.expect_another_dish()

    def release(self) -> None:
        """Let go of the latch. Nothing moves by it."""
        self.latched = False
        if self._keeper is not None:
            self._keeper.release()
        if self._store.state.held is not None:
            self._tell_held(None)

    def _tell_held(self, held: HeldState | None) -> None:
        self._store.change(held=held)
        self._store.tell(HeldChanged(*self._store.stamp(), held))

    def _pass_to(self, holder: str | None) -> None:
        previous = self._store.state.holder
        self.due = None
        self._store.change(holder=holder, holder_until=None)
        self._store.tell(LeaseChanged(*self._store.stamp(), holder, previous))
