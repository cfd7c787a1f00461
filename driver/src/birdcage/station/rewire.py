"""Which port, which rate: looks at a port that does not answer, and changes over to another."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from birdcage.base.errors import BirdcageError, LinkError, Stopped
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.detection.clues import known_tokens
from birdcage.detection.machine_probe import ask, questions
from birdcage.detection.probe import USUAL_BAUDS, BaudFinding, Saw, probe
from birdcage.link.opening import has_speed
from birdcage.rotator.values import Survey
from birdcage.station.connection import Connection
from birdcage.station.dish_monitor import DishMonitor
from birdcage.station.parts import Parts
from birdcage.station.state import MOVING, LinkPhase, TvSearch

PROBE_DEADLINE_S = 20.0
"""No further rate is tried after this: `rfc2217://` may take 3 s to open, each time."""


class Rewire:
    """Serves `ProbePort` and `Connect`. The port is closed for both, so neither is done while the dish moves."""

    def __init__(
        self, parts: Parts, connection: Connection, monitor: DishMonitor, wake: Wake, on_wake: Callable[[], None]
    ) -> None:
        self._store, self._antenna, self._settings = parts.store, parts.antenna, parts.settings
        self._stopper, self._reader = parts.stopper, parts.reader
        self._connection, self._monitor, self._wake, self._on_wake = connection, monitor, wake, on_wake

    def probe(self, bauds: tuple[int, ...] = ()) -> tuple[BaudFinding, ...]:
        """Listen at the present rate, then at `bauds` or the usual ones, until one shows a prompt.

        At each, one bare Enter is sent, and `?` where a prompt answers. Where all is silent, whole machines are asked,
        each by its question that moves nothing (`LineProbe`). Afterwards the station tries again as before.
        A port whose rate is not ours to set (`socket://`) is heard once. Raises LinkError when the port cannot be
        opened or is lost, BirdcageError (`moving`) while the dish moves, Stopped when STOP or the end of the station
        came first.
        """
        self._refuse_while_moving("The port is not probed")
        port = self._connection.find()
        if port is None:
            raise LinkError(f"{self._store.state.port} is not there: plug it in.", reason=Reason.MISSING)
        present = self._connection.baud
        rates = dict.fromkeys((present, *(bauds or USUAL_BAUDS))) if has_speed(port) else (present,)
        self._connection.let_go()
        try:
            return self._listen(port, rates)
        finally:
            self._connection.begin()

    def _listen(self, port: str, rates: Iterable[int]) -> tuple[BaudFinding, ...]:
        clock, stops_before = self._store.clock, self._stopper.count
        tokens = known_tokens()
        until = clock.monotonic() + PROBE_DEADLINE_S
        findings: list[BaudFinding] = []

        def on_wake() -> None:
            self._on_wake()
            if self._stopper.count != stops_before:
                raise Stopped("STOP ended the look at the port.")

        for baud in rates:
            if findings and clock.monotonic() >= until:
                break
            on_wake()
            self._connection.tell_opening(f"listening on {port} at {baud} baud")
            link = self._settings.open_link(port, baud)
            try:
                findings.append(probe(link, clock, baud, tokens=tokens, wake=self._wake, on_wake=on_wake))
            finally:
                link.close()
            if findings[-1].saw is Saw.PROMPT:
                break
        if all(each.saw is Saw.SILENCE for each in findings):
            for question, own_rate in questions():
                baud = own_rate if own_rate and has_speed(port) else self._connection.baud
                on_wake()
                link = self._settings.open_link(port, baud)
                try:
                    findings.append(ask(link, clock, baud, question, wake=self._wake, on_wake=on_wake))
                finally:
                    link.close()
        return tuple(findings)

    def connect(self, port: str, baud: int | None) -> None:
        """Use this port and rate from now on (None: the firmware's own). Returns before it is open.

        What answers there may be another dish: what is known of this one is forgotten. BirdcageError (`moving`) while
        the dish moves.
        """
        self._refuse_while_moving("The port is not changed")
        gate = self._antenna.gate
        # The same port has most likely the same dish: that its motors were released must not be forgotten then.
        released = set(gate.released) if port in (self._store.state.port, self._connection.asked_port) else set()
        self._connection.let_go()
        self._connection.use(port, baud)
        self._monitor.expect_another_dish()
        gate.released = released
        self._antenna.strategy.forget_learnt()
        self._reader.limit(Survey())
        self._store.forget_readings()
        self._store.change(position=None, search=TvSearch.UNKNOWN, firmware_version=None)
        self._connection.begin()

    def _refuse_while_moving(self, so: str) -> None:
        if self._is_moving():
            raise BirdcageError(f"{so} while the dish moves: STOP would not reach it meanwhile.", reason=Reason.MOVING)

    def _is_moving(self) -> bool:
        state, motion = self._store.state, self._antenna.motion
        match state.link.state:
            case LinkPhase.UP:
                return motion is not None or state.activity in MOVING or state.raw_motion
            case LinkPhase.SILENT:
                # STOP may still reach it. No reading will show it arrive: its motion counts until it must have ended.
                clock = self._store.clock
                return motion is not None and clock.monotonic() < motion.over_by(clock.rate)
        return False
