"""Serves programs that know only a serial port: one thread, one pseudo terminal, one program after the other."""

from __future__ import annotations

import contextlib
import logging
import select
import threading
from collections.abc import Callable

from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.rotctld.client_rotor import ClientRotor
from birdcage.rotctld.easycomm_conversation import EasycommConversation, EasycommError
from birdcage.rotctld.easycomm_port import EasycommPort
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.rprt import RotctldError
from birdcage.rotctld.seen_dish import known_position
from birdcage.rotctld.server import DISH_S, END_S
from birdcage.rotctld.shared_dish import SharedDish
from birdcage.station.access import StationAccess
from birdcage.station.state import StationState

WATCHER = "easycomm"
"""Who watches the position for it; a program at the port is `easycomm 1`, the next one `easycomm 2`."""
LOOK_S = 1.0
NOT_FOUND = (Reason.UNHOMED, Reason.UNSYNCED, Reason.UNTOLD, Reason.RELEASED, Reason.HOMING)
"""Why a position is not known that homing would find, or a person's word."""

log = logging.getLogger("birdcage.rotctld")


class EasycommService:
    """As `RotctldService` for its clients. `shutdown` is for any thread but its own."""

    def __init__(
        self, station: StationAccess, port: EasycommPort, options: RotctldOptions,
        tell: Callable[[str], object] = lambda _words: None,
    ) -> None:  # fmt: skip
        """`tell` hears of each program that comes and goes, on the serving thread. The port is closed in the end."""
        self._station, self._port, self._tell = station, port, tell
        self._dish = SharedDish(station, options, watcher=WATCHER)
        self._rotor: ClientRotor | None = None
        self._talk: EasycommConversation | None = None
        self._came = 0
        self._ending, self._wake = threading.Event(), Wake()
        self._thread: threading.Thread | None = None
        self.crash: BaseException | None = None
        """What ended the thread of `start`, if it was not `shutdown`."""

    def start(self) -> None:
        """Serve on a thread of its own."""
        self._thread = threading.Thread(target=self._run, name="easycomm", daemon=True)
        self._thread.start()

    def shutdown(self) -> None:
        """End what its program moves, and take the port away."""
        self._ending.set()
        self._wake.set()
        if self._thread is not None:
            self._thread.join(END_S)

    def step(self, longest_s: float) -> None:
        """Serve what is due; wait for that so long at most."""
        due = self._dish.tick()
        now = self._station.clock.monotonic()
        wait_s = max(0.0, longest_s if due is None else min(longest_s, due - now))
        heard: list[EasycommPort | Wake] = [self._port, self._wake]
        ready, writable, _ = select.select(heard, [self._port] if self._port.has_unread else [], [], wait_s)
        if self._wake in ready:
            self._wake.clear()
        if writable:
            self._port.write()
        if self._port in ready:
            self._take(self._port.read())

    def _take(self, data: bytes | None) -> None:
        if data is None:
            self._leave()
        elif data:
            if self._talk is None:
                self._came += 1
                self._rotor = self._dish.client(f"{WATCHER} {self._came}")
                self._talk = EasycommConversation(self._rotor, lambda: errors_of(self._station.state))
                self._tell(f"A program talks at {self._port.path} ({self._rotor.name_of_lease}).")
            for reply in self._talk.feed(data):
                self._port.write(reply)

    def _leave(self) -> None:
        rotor, self._rotor, self._talk = self._rotor, None, None
        if rotor is not None:
            rotor.leave()
            self._tell(f"The program at {self._port.path} has closed it ({rotor.name_of_lease}).")

    def _run(self) -> None:
        try:
            while not self._ending.is_set():
                self.step(LOOK_S if self._rotor is None else DISH_S)
        except BaseException as crash:
            log.exception("the server for serial programs has failed")
            self.crash = crash
        finally:
            if self._rotor is not None:
                with contextlib.suppress(RotctldError):  # there is no link: the dish can't be told
                    self._rotor.stop()
            self._leave()
            self._port.close()
            self._wake.close()


def errors_of(state: StationState) -> EasycommError:
    """Return what `GE` tells of the dish now."""
    errors = EasycommError.NONE
    if state.fault is not None:
        errors |= EasycommError.MOTOR
    if known_position(state) is None:
        errors |= EasycommError.HOMING if state.position_lost in NOT_FOUND else EasycommError.SENSOR
    return errors
