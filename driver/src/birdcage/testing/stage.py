"""A station, a machine and its twin in one thread on a virtual clock: what a case of the contract works with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import separation, shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator import machines
from birdcage.rotator.facts import Facts, Readback
from birdcage.station.events import Event
from birdcage.station.requests import AcknowledgeFault, Goto, ReleaseLease, Request, Sync, Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import Activity, LinkPhase, StationState
from birdcage.station.station import Station
from birdcage.testing.twin import MachineBench, SeenCommand, Truth, Twin

STEP_S = 0.1
LONGEST_MOVE_S = 240.0
SEAM_DEG = 20.0
"""How far from north targets are chosen: a cable may make a machine go the long way round there."""
FIRST_DEG = (30.0, 10.0)
"""How far a machine that does not tell its position is sent, before it can be known."""
TOLD_DEG = 10.0
"""How far one may have gone since it last told, on its way, where it is."""


def require(held: object, sentence: str) -> None:
    """Fail the case with a sentence unless something holds."""
    if not held:
        raise AssertionError(sentence)


class Stage:
    """Opened with `with`; closed as a program closes, and nothing of it is left."""

    def __init__(
        self,
        bench: MachineBench,
        twin: Callable[[VirtualClock], Twin] | None = None,
        settings: Mapping[str, Any] | None = None,
    ) -> None:
        """`twin` and `settings` replace, or add to, those of the bench."""
        self.bench = bench
        self.clock = VirtualClock()
        self.twin: Twin = (twin or bench.twin)(self.clock)
        more = {**bench.settings, **(settings or {})}
        self.station = Station(
            self.clock,
            StationSettings(
                port=self.twin.address, firmware=bench.machine, open_link=self.twin.dial,
                **more,
            ),
        )  # fmt: skip
        self.session = Session(self.clock, self.station)
        self.events: list[Event] = []
        self.station.subscribe(self.events.append)

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.session.close()

    @property
    def facts(self) -> Facts:
        """What is known of the machine: what it has told of itself lies over what its class says."""
        return self.state.dish or machines.facts_of(self.bench.machine)

    @property
    def state(self) -> StationState:
        """What a person is shown."""
        return self.station.state

    @property
    def truth(self) -> Truth:
        """What the mechanics do."""
        return self.twin.truth()

    def ready(self) -> Stage:
        """Open, meet, and read everything there is; somebody looks at the position from then on."""
        self.station.submit(Watch("contract", frozenset({"position"}), 2.0))
        self.until(
            lambda: (
                self.state.link.state is LinkPhase.UP
                and self.state.surveyed
                and (self.is_found or not self.tells or self.must_be_synced)
            ),
            self.bench.ready_s,
            "the machine was met and its position read",
        )
        self.sync()
        self.until(lambda: self.state.activity is Activity.IDLE, self.bench.ready_s, "the machine was seen at rest")
        require(self.tells or self.knows_nothing(), f"it was not told, and {self.state.position} is claimed")
        return self

    def found(self) -> Stage:
        """Have it ready and its position known: a machine that does not tell it is sent somewhere for that."""
        self.ready()
        if not self.tells:
            self.go(*FIRST_DEG)
            self.do(ReleaseLease("contract"))
        return self

    @property
    def tells(self) -> bool:
        """Whether this machine tells its position; else it is driven by time, and its position is modelled."""
        return self.facts.tells_at_rest

    @property
    def must_be_synced(self) -> bool:
        """Whether it waits for a person to sync it."""
        return self.state.position_lost == Reason.UNSYNCED

    def sync(self) -> None:
        """Sync it to where its mechanics point, where only a person can."""
        if self.must_be_synced:
            if self.state.fault is not None:
                self.do(AcknowledgeFault("contract"))
            self.do(Sync(self.truth.az_deg % 360.0, self.truth.el_deg, "contract", agreed=True))

    @property
    def is_found(self) -> bool:
        """Whether a position is shown."""
        return self.state.position is not None and self.state.position_lost is None

    def tells_truth_on_its_way(self) -> bool:
        """Return whether what is shown of a moving machine was told by it, and is where it can be or just was."""
        here, truth = self.state.position, self.truth
        if here is None or here.modelled or self.facts.readback is not Readback.MOVING:
            return False
        way_deg = separation(here.dish_az_deg, here.dish_el_deg, truth.az_deg, truth.el_deg)
        return way_deg <= TOLD_DEG

    def knows_nothing(self) -> bool:
        """Return whether the position is shown as one that a machine does not tell."""
        return self.state.position is None and self.state.awaits_first_move

    def step(self, seconds: float) -> None:
        """Let time pass; of a machine that does not tell where it rests, nothing is called read there, or confirmed."""
        self.session.step(seconds)
        if self.tells:
            return
        here, stop, homed = self.state.position, self.state.last_stop, self.state.homed
        rests = self.state.activity is Activity.IDLE or self.facts.readback is Readback.NEVER
        require(
            here is None or here.modelled or not rests, f"nothing told its position, and it is shown as read: {here}"
        )
        require(homed is None, f"nothing told whether it is homed, and it is shown as {homed}")
        require(
            stop is None or stop.confirmed is not True, f"nothing told that it stopped, and STOP is confirmed: {stop}"
        )

    def until(self, holds: Callable[[], bool], within_s: float, what: str) -> None:
        """Let time pass until something holds; fail the case after `within_s`."""
        end = self.clock.monotonic() + within_s
        while not holds():
            state = self.state
            require(
                self.clock.monotonic() < end,
                f"not within {within_s:g} s: {what}. Link {state.link.state.value} ({state.link.detail}), "
                f"{state.activity.value}, position {state.position}, fault {state.fault}, last STOP {state.last_stop}",
            )
            self.step(STEP_S)

    def do(self, request: Request, within_s: float = LONGEST_MOVE_S) -> Any:  # noqa: ANN401 - as the request says
        """Ask for something, and return its result or raise its error."""
        future = self.station.submit(request)
        self.until(future.done, within_s, f"{request} was answered")
        return future.result(0)

    def refused(self, request: Request, *errors: type[BirdcageError], within_s: float = 10.0) -> BirdcageError:
        """Return the error with which something is refused; any other outcome fails the case."""
        try:
            result = self.do(request, within_s)
        except errors as error:
            return error
        raise AssertionError(f"{request} was not refused: {result}")

    def go(self, d_az_deg: float, d_el_deg: float) -> tuple[float, float]:
        """Go a way off, and return the target."""
        target = self.target(d_az_deg, d_el_deg)
        self.do(Goto(*target, "contract"))
        return target

    def target(
        self, d_az_deg: float, d_el_deg: float, *, start: tuple[float, float] | None = None
    ) -> tuple[float, float]:
        """Return a direction so far from here that is allowed: the other way round where this one leads out of it.

        Of a machine with a mapping: the nearest direction that it reaches.
        """
        here_az, here_el = (self.truth.az_deg % 360.0, self.truth.el_deg) if start is None else start
        low, high = self.elevations
        az_deg, el_deg = here_az + d_az_deg, here_el + d_el_deg
        if not SEAM_DEG <= az_deg <= 360.0 - SEAM_DEG:
            az_deg = here_az - d_az_deg
        if not low <= el_deg <= high:
            el_deg = here_el - d_el_deg
        mapping = self.facts.mapping
        if mapping is not None:
            az_deg, el_deg = mapping.to_sky(mapping.to_axes(az_deg, el_deg)[0])
        require(low <= el_deg <= high, f"no elevation {d_el_deg}° from {here_el:.2f}° within {low:.2f}° to {high:.2f}°")
        return round(az_deg % 360.0, 2), round(el_deg, 2)

    @property
    def elevations(self) -> tuple[float, float]:
        """The limits as they are shown."""
        low, high = self.state.el_min_deg, self.state.el_max_deg
        require(low is not None and high is not None, "the limits of elevation are not shown")
        assert low is not None
        assert high is not None
        return low, high

    def taken_since(self, at: float) -> list[SeenCommand]:
        """Return the commands of moves that reached the machine after a moment."""
        return [each for each in self.twin.taken() if each.at > at]

    def stands_at(self, az_deg: float, el_deg: float) -> bool:
        """Return whether the mechanics rest there, as near as this machine gets."""
        truth, near = self.truth, self.bench.near_deg
        return (
            not truth.moving and abs(shortest_turn(az_deg, truth.az_deg)) <= near and abs(truth.el_deg - el_deg) <= near
        )

    def rests_for(self, seconds: float) -> bool:
        """Return whether the mechanics stand still for so long."""
        before = self.truth
        for _ in range(round(seconds / STEP_S)):
            self.step(STEP_S)
            now = self.truth
            if now.moving or now.az_deg != before.az_deg or now.el_deg != before.el_deg:
                return False
        return True

    def shows_truth(self) -> bool:
        """Return whether the position on the board is where the mechanics are."""
        here, truth, near = self.state.position, self.truth, self.bench.near_deg
        return (
            here is not None
            and self.state.position_lost is None
            and abs(shortest_turn(truth.az_deg, here.dish_az_deg)) <= near
            and abs(truth.el_deg - here.dish_el_deg) <= near
        )
