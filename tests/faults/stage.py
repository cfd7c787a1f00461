"""A station and a simulated dish on a virtual clock, with everything written down that an ordeal is judged by."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.link import Link
from birdcage.link.ports import PortInfo
from birdcage.sim.port import SimPort, open_device
from birdcage.station.build import _finder
from birdcage.station.requests import Sync, Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

from .fault import CONSOLES, TIMED
from .recorder import Recorder

PORT = "/dev/ttyUSB0"
OTHER_PORT = "/dev/ttyUSB1"
STEP_S = 0.1
TARGET = re.compile(rb"(AZ|EL)-?\d")
"""A line of the rotator without a prompt that sends it."""
ADDRESSES = {
    "g2": "g2?seed=1&az=-180&az_speed=10&el_speed=3",
    "g2plus": "g2plus?seed=1&az=-180&az_speed=10&el_speed=3",
    "hal205": "hal205?seed=1&boot_home_s=20&search_finds=0",
    "hal000": "hal000?seed=1&boot_home_s=20&search_finds=0",
    "pro": "pro?seed=1&boot_home_s=20&search_finds=0&odu_gap_s=0.9&motor_gap_s=0.15",
    "pathway-x1": "pathway-x1?seed=1&az=-180&az_speed=10&el_speed=3",
    "pathway-x2": "pathway-x2?seed=1&az=-180&az_speed=10&el_speed=3&lag_min_s=1&lag_max_s=1",
    "easycomm": "easycomm?seed=1&az=90&el=25&el_homes=0",
}
"""The dialects of the matrix, and a dish of each whose slews are long enough for something to happen in them."""


@dataclass(frozen=True, slots=True)
class Written:
    """Bytes that left the port."""

    at: float
    data: bytes
    stopping: bool
    """Whether STOP wrote them."""

    @property
    def moves(self) -> bool:
        """Whether these bytes set an axis in motion, on any of the dialects."""
        return any(
            line in (b"r", b"e", b"stow") or line.startswith((b"a ", b"g ", b"h ")) or TARGET.match(line)
            for line in re.split(b"[\r\n]", self.data)
        )


class RecordingPort(SimPort):
    """Notes what is written, and looks at the truth before each line goes out."""

    def __init__(self, stage: Stage, name: str, baud: int | None) -> None:
        super().__init__(stage.device, name, baud=baud)
        self._stage = stage

    def write(self, data: bytes) -> None:
        stage = self._stage
        stage.recorder.asked(data)
        super().write(data)
        stage.written.append(Written(stage.clock.monotonic(), data, stage.stopping))


@dataclass
class Stage:
    """One dish, one station, one cable."""

    dialect: str
    options: str = ""
    written: list[Written] = field(default_factory=list)
    stopping: bool = False
    """Whether what is written now is STOP's own."""

    def __post_init__(self) -> None:
        self.clock = VirtualClock()
        self.device = open_device(ADDRESSES[self.dialect] + self.options, clock=self.clock)
        self.path: str | None = PORT
        """Where the adapter is plugged in; None while it is nowhere."""
        settings = StationSettings(
            port=PORT, firmware=self.dialect, open_link=self._open, find_port=_finder(PORT, None, self._ports)
        )
        self.station = Station(self.clock, settings)
        self.session = Session(self.clock, self.station)
        self.recorder = Recorder(self)
        self.station.subscribe(self.recorder.hear)
        self._mark_stop()
        self._count_starts()

    def _ports(self) -> list[PortInfo]:
        stranger = PortInfo("/dev/ttyS0")
        return [stranger, *([PortInfo(self.path, None, "FTDI", "0403:6001", "A1", "1-1")] if self.path else [])]

    def _open(self, port: str, baud: int) -> Link:
        if port != self.path:
            raise LinkError(f"There is no port {port}.", reason="missing")
        try:
            self.port = RecordingPort(self, port, baud)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error
        return Link(self.port, self.clock)

    @property
    def has_restarted(self) -> bool:
        """Whether the dish has started, or lost its power, since it was met."""
        return self.starts > 0

    def _count_starts(self) -> None:
        self.starts = 0
        stop = self.device._stop

        def stopping() -> None:
            self.starts += 1
            stop()

        self.device._stop = stopping

    def _mark_stop(self) -> None:
        """Lines that STOP writes are known by the one way that they go."""
        rotator = self.station._antenna.rotator
        writer, name = (rotator.protocol, "interject") if self.has_menus else (rotator._rotator, "stop_now")
        write = getattr(writer, name)

        def writing(what: object) -> None:
            self.stopping = True
            try:
                write(what)
            finally:
                self.stopping = False

        setattr(writer, name, writing)

    @property
    def has_menus(self) -> bool:
        """Whether it is a console."""
        return self.dialect in CONSOLES

    @property
    def tells(self) -> bool:
        """Whether it tells where it points."""
        return self.dialect not in TIMED

    @property
    def may_move(self) -> bool:
        """Whether one that does not tell may still be on its way."""
        return self.station._antenna.reckoning.moves_until > self.now

    @property
    def motor_menu(self) -> str:
        """Where the dish takes moves."""
        return self.station._antenna.rotator.protocol.motor_menu

    @property
    def state(self):
        """What the station says now."""
        return self.station.state

    @property
    def truth(self):
        """What the dish does now."""
        return self.device.truth()

    @property
    def now(self) -> float:
        """Monotonic seconds."""
        return self.clock.monotonic()

    @property
    def is_up(self) -> bool:
        """Whether the dish answers."""
        return self.state.link.state is LinkNow.UP

    def step(self, seconds: float) -> None:
        """Let time pass, looking often."""
        end = self.now + seconds
        while self.now < end - 1e-9:
            self.session.step(min(STEP_S, end - self.now))
            self.recorder.glance()

    def until(self, true, seconds: float) -> bool:
        """Let time pass until something holds; return whether it came to that."""
        end = self.now + seconds
        while not true():
            if self.now >= end:
                return False
            self.step(STEP_S)
        return True

    def connect(self) -> None:
        """Come up, with somebody who watches."""
        features = {"position", "rssi"} if self.state.dish.has_rssi else {"position"}
        self.station.submit(Watch("person", frozenset(features), 2.0))
        assert self.until(lambda: self.is_up and self.state.surveyed, 60.0), self.state.link
        self.sync()
        self.step(3.5)

    @property
    def must_be_synced(self) -> bool:
        """Whether it waits for a person to sync it."""
        return self.state.position_lost == Reason.UNSYNCED

    def sync(self) -> None:
        """Sync it, where only a person can."""
        if self.must_be_synced:
            told = self.do(Sync(self.truth.az_deg, None, "you", agreed=True))
            assert not isinstance(told, Exception), told

    def do(self, request, seconds: float = 120.0):
        """Ask for something and wait for it; return what came of it, an error included."""
        future = self.station.submit(request)
        if not self.until(future.done, seconds):
            return TimeoutError(f"{request} was not done within {seconds:g} s")
        return future.exception(0) or future.result(0)

    def stop(self) -> bytes:
        """Press STOP; return what left the port before the call came back."""
        before = len(self.written)
        self.station.stop("you")
        return b"".join(each.data for each in self.written[before:])
