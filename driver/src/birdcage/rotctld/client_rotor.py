"""The dish as one client of the network protocol has it: its wishes become requests under its own lease."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from contextlib import suppress
from typing import TYPE_CHECKING

from birdcage.rotctld.client_console import send_line
from birdcage.rotctld.client_tuner import ClientTuner
from birdcage.rotctld.client_view import ClientRole, ClientView
from birdcage.rotctld.client_wishes import READ_ONLY, ClientWishes
from birdcage.rotctld.directions import pointed
from birdcage.rotctld.renewed_drive import RenewedDrive
from birdcage.rotctld.rotor import Advertised, MoveDirection, SignalCounts
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.rotctld.status_words import status_words
from birdcage.station.requests import EndMotion
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.rotctld.shared_dish import SharedDish

SETTLE_S = 0.1
"""How often it is looked whether the dish is seen at rest again."""


class ClientRotor:
    """Keeps the protocol `Rotor`. Made by `SharedDish.client`, and used on the server's thread alone.

    A wish that cannot be carried out raises nothing unless the server is strict: it is counted, and shown.
    """

    def __init__(self, shared: SharedDish, name: str) -> None:
        self._shared, self._station, self._options = shared, shared.station, shared.options
        self.name_of_lease = name
        self._wishes = ClientWishes(shared, name)
        self._told: tuple[float, float] | None = None
        self._drive = RenewedDrive(self._station, name, self._options.drive_s)
        self._tuner = ClientTuner(self._station, name)

    # What it is told

    def position(self) -> tuple[float, float]:
        """Return where the dish is; over a short loss of the link, where it was last seen."""
        self._told, now = None, self._now
        self._wishes.pursuit.heard(now)
        here = self._shared.seen.position(self._station.state, now)
        self._told = here.az_deg, here.el_deg
        return self._told

    def name(self) -> str:
        """Return what the dish answers to `_`: its machine's own name, before any machine has answered `birdcage`."""
        dish = self._station.state.dish
        return "birdcage" if dish is None else dish.rotctld_name or dish.name

    def advertised(self) -> Advertised:
        """Return a range as wide as is sensible: Hamlib's clients drop what lies outside; here it is clamped."""
        return Advertised()

    def status(self) -> tuple[str, ...]:
        """Return the words of Hamlib's `get_status` that are true now. EIO or ETIMEOUT while the link is lost."""
        state = self._station.state
        if state.link.state is not LinkPhase.UP:
            raise self._shared.seen.error(state)
        return status_words(state, busy=bool(self._wishes.obstacle()))

    def abilities(self) -> tuple[str, ...]:
        """Return `rssi` and `lna`, as far as the dish has them."""
        return self._tuner.abilities()

    def read_signal(self, reads: int) -> Future[SignalCounts]:
        """Have the signal read so often. EIO without a tuner, ERJCTED while others use it and it has told nothing."""
        return self._tuner.read(reads)

    # What it sets

    def enable_lna(self) -> Future[None]:
        """Switch the supply of the LNB on. EIO without one, ERJCTED while others use the tuner."""
        self._refuse_read_only()
        return self._tuner.enable_lna()

    def send(self, line: str) -> Future[Sequence[str]]:
        """Send a harmless line to the dish's own console. ERJCTED for any other, and while the dish moves."""
        self._refuse_read_only()
        return send_line(self._station, self.name_of_lease, line)

    def _refuse_read_only(self) -> None:
        if self._options.read_only:
            raise RotctldError(Rprt.ERJCTED, READ_ONLY)

    # Its wishes

    def set_position(self, az_deg: float, el_deg: float) -> None:
        """Take a wish. EIO or ETIMEOUT while the dish is out of sight for longer than is held over."""
        self._drive.end()
        self._wishes.pursuit.heard(self._now)
        self._wishes.take(pointed(az_deg, el_deg))

    def park(self) -> None:
        """Go to the named park position: a wish like others, but ERJCTED where it is not carried out.

        ENAVAIL where none is set, or it is out of reach. The dish is never stowed.
        """
        self._refuse_read_only()
        self._drive.end()
        park = self._shared.park_position()
        if why := self._wishes.obstacle():
            self._wishes.note_ignored(why)
            raise RotctldError(Rprt.ERJCTED, why)
        self._wishes.end_stream()
        self._wishes.take(park)

    def move(self, direction: MoveDirection, speed: int) -> None:  # noqa: ARG002 - the dish goes at its own speed
        """Go on in a direction for `RotctldOptions.drive_s`; ERJCTED where nothing may move.

        The speed of the dish is its own: the protocol's is not used. EIO or ETIMEOUT while the link is lost.
        """
        self._refuse_read_only()
        both = (MoveDirection.LEFT | MoveDirection.RIGHT, MoveDirection.UP | MoveDirection.DOWN)
        if not direction or any(direction & pair == pair for pair in both):
            raise RotctldError(Rprt.EINVAL, f"{int(direction)} is no direction.")
        now = self._now
        self._wishes.forget()
        self._shared.idle.wished()
        state = self._station.state
        if state.link.state is not LinkPhase.UP:
            raise self._shared.seen.error(state)
        if why := self._wishes.obstacle(resumes=False):
            self._wishes.note_ignored(why)
            raise RotctldError(Rprt.ERJCTED, why)
        self._wishes.why = ""
        self._shared.take_from_departed()
        self._drive.hold(direction, now)

    def stop(self) -> None:
        """End this client's motion and give its control back; HELD and others stay as they are.

        What a client that has hung up left in motion is anybody's: it ends, too. EIO or ETIMEOUT where the link is
        lost: the dish cannot be told.
        """
        self._drive.end()
        self._wishes.forget()
        self._station.submit(EndMotion(self._shared.departed_holder or self.name_of_lease))
        if self._station.state.link.state is not LinkPhase.UP:
            raise self._shared.seen.error(self._station.state)

    def shut_out(self, *, on: bool) -> None:
        """Ignore its wishes from now on, and end what it moves; or take them again from the next one on."""
        if on and not self._wishes.shut_out:
            with suppress(RotctldError):  # there is no link: the dish can't be told
                self.stop()
        self._wishes.shut_out = on

    def leave(self) -> None:
        """It hung up: its motion is finished; a drive and a pursuit end; its control is given back then."""
        has_task = any(task.holder == self.name_of_lease for task in self._station.state.tasks)
        if self._drive.due is not None or self._wishes.pursuit.follows or has_task:
            self._station.submit(EndMotion(self.name_of_lease))
        self._drive.end()
        self._shared.left(self, self._wishes.motion)

    # For `SharedDish`

    def tick(self, now: float) -> None:
        """Go on driving, and see to the wish that waits for the dish."""
        self._wishes.tick(now)
        if why := self._drive.tick(now):
            self._wishes.note_ignored(why)

    def due(self, now: float) -> float | None:
        """Return when `tick` has something to do, in monotonic seconds; None while nothing waits for a time."""
        if self._wishes.waits:
            return now + SETTLE_S
        return min((due for due in (self._drive.due, self._wishes.due) if due is not None), default=None)

    def view(self, now: float) -> ClientView:
        """Return what is to be shown of it."""
        wishes = self._wishes
        wishes.hear_outcome()
        role = ClientRole.WATCHES
        if wishes.has_control:
            role = ClientRole.CONTROL
        elif wishes.shut_out or (wishes.why and wishes.wish is not None):
            role = ClientRole.IGNORED
        return ClientView(
            self.name_of_lease, role, wishes.wish, wishes.at, wishes.ignored, wishes.why, self._told, wishes.waits,
            stale=self._shared.seen.is_held_over(now), shut_out=wishes.shut_out, lead_s=wishes.lead_s,
            following=wishes.pursuit.following,
        )  # fmt: skip

    @property
    def _now(self) -> float:
        return self._station.clock.monotonic()
