"""The dish as all clients of one server share it: one watch of its position, one holder of its control."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.rotator.feature import POSITION
from birdcage.rotctld.client_rotor import SETTLE_S, ClientRotor
from birdcage.rotctld.client_view import ClientView, WishedDirection
from birdcage.rotctld.idle_park import IdlePark
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.recogniser import Recogniser
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.rotctld.seen_dish import SeenDish
from birdcage.station.access import StationAccess
from birdcage.station.requests import ReleaseLease, Unwatch, Watch

WATCHER = "rotctld"
"""Who watches the position for all clients, and has control while the dish parks because none is left."""
LOOK_S = 0.5
"""How often it is looked whether the dish is still in sight, while clients are there."""


class SharedDish:
    """One for each server; all of it for the server's thread."""

    def __init__(
        self, station: StationAccess, options: RotctldOptions, recogniser: Recogniser | None = None, *,
        watcher: str = WATCHER,
    ) -> None:  # fmt: skip
        """`recogniser`: None where satellites that clients follow are not recognised."""
        self._watcher = watcher
        self.station, self.options, self.recogniser = station, options, recogniser
        self.seen = SeenDish(options)
        self._clients: dict[str, ClientRotor] = {}
        self._leaving: dict[str, Future[object]] = {}
        """Clients that hung up, by name, with the motion that is being finished."""
        self.idle = IdlePark(station, options, self._watcher)
        """Parks once none is left."""

    def client(self, name: str) -> ClientRotor:
        """Let a client join; `name` holds its control. ValueError where another one has that name."""
        if name in self._clients or name in self._leaving:
            raise ValueError(f"There is a client called {name} already.")
        if not self._clients:
            self.station.submit(Watch(self._watcher, frozenset({POSITION})))
        client = self._clients[name] = ClientRotor(self, name)
        return client

    def left(self, client: ClientRotor, motion: Future[object] | None) -> None:
        """A client has hung up; `motion` is what it still moves, None for nothing."""
        name = client.name_of_lease
        if self._clients.pop(name, None) is None:
            return
        if motion is not None or self.station.state.holder == name:
            self.idle.left(name, self.station.clock.monotonic())
        if motion is None:
            self.station.submit(ReleaseLease(name))
        else:
            self._leaving[name] = motion
            # Not from `tick`: the server may end before the motion does.
            motion.add_done_callback(lambda _motion: self.station.submit(ReleaseLease(name)))
        if not self._clients:
            self.station.submit(Unwatch(self._watcher))

    @property
    def departed_holder(self) -> str:
        """The client that has control though it has hung up, while its motion is finished; empty if none."""
        holder = self.station.state.holder
        return holder if holder is not None and holder in self._leaving else ""

    def take_from_departed(self) -> None:
        """Free control for a client that is still there, if one that has hung up has it."""
        if holder := self.departed_holder:
            self.station.submit(ReleaseLease(holder))

    def park_position(self) -> WishedDirection:
        """Return the named park position. ENAVAIL where none is set, or the dish may not stand there."""
        if self.options.park is None:
            raise RotctldError(
                Rprt.ENAVAIL, "No park position is set: [tracking] park_az_deg and park_el_deg in birdcage.toml."
            )
        park, state = WishedDirection(*self.options.park), self.station.state
        where = f"The park position {park.az_deg:.2f}°/{park.el_deg:.2f}°"
        for sector in state.no_go_sectors:
            if park.el_deg < sector.el_below_deg and sector.overlaps(park.az_deg, 0.0):
                raise RotctldError(Rprt.ENAVAIL, f"{where} lies in a no-go sector below {sector.el_below_deg:.2f}°.")
        low, high = state.el_min_deg, state.el_max_deg
        if (low is not None and park.el_deg < low) or (high is not None and park.el_deg > high):
            raise RotctldError(Rprt.ENAVAIL, f"{where} is out of reach: the elevation goes from {low}° to {high}°.")
        return park

    def tick(self) -> float | None:
        """Do what is due by time; return when to come again, in monotonic seconds, None if nothing waits."""
        now = self.station.clock.monotonic()
        self.seen.look(self.station.state, now)
        if self.recogniser is not None and self._clients:
            self.recogniser.tick(now)
        for client in tuple(self._clients.values()):
            client.tick(now)
        for name, motion in tuple(self._leaving.items()):
            if motion.done():
                del self._leaving[name]
        if not self._leaving:
            self.idle.tick(now, self.park_position)
        times = [due for client in self._clients.values() if (due := client.due(now)) is not None]
        if self._leaving:
            times.append(now + SETTLE_S)
        if self._clients or self.idle.due is not None:
            times.append(now + LOOK_S)
        return min(times, default=None)

    def views(self) -> tuple[ClientView, ...]:
        """Return what is to be shown of each client, in the order in which they came."""
        now = self.station.clock.monotonic()
        return tuple(client.view(now) for client in self._clients.values())
