"""A station and the thread that runs it."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.link.transcript import Transcript
from birdcage.link.transcript_line import TranscriptEntry
from birdcage.station.state import Pointing
from birdcage.station.station import Station
from birdcage.station.stop_pending import StopReach

QUIT_S = 0.15
"""How long closing may wait for the thread: STOP's bytes leave in 3 ms, their answers take a few more."""

LOOK_S = 0.1
"""How long closing may wait until STOP has seen where to aim: two readings, a twentieth of a second apart."""
SPEEDS_S = 2.0
"""How long closing may wait until changed speeds are put back: STOP's readings, and some ten exchanges."""
SLICE_S = 0.005


class Session:
    """`Session(clock, station)`: `start` runs the station on a daemon thread of our own; tests `step` it instead."""

    def __init__(
        self,
        clock: Clock,
        station: Station,
        on_close: Callable[[], None] = lambda: None,
        wire: Transcript | None = None,
    ) -> None:
        self.clock, self.station = clock, station
        self._on_close = on_close
        self._wire = wire
        self._begun = False
        self._thread: threading.Thread | None = None
        self.crash: BaseException | None = None
        """What ended the thread, if it was not `close`."""

    def start(self) -> None:
        """Run the station on its own thread."""
        self._thread = threading.Thread(target=self._run, name="station", daemon=True)
        self._thread.start()

    def on_wire(self, listener: Callable[[TranscriptEntry], None]) -> Callable[[], None]:
        """Call `listener` with every chunk that passes on the wire, and every remark; the result ends that.

        It is called on whichever thread read or wrote, before the next byte can leave: append to a queue and return.
        BirdcageError for a session that was built without a transcript.
        """
        if self._wire is None:
            raise BirdcageError("This session was built without a transcript, so its wire can't be heard.")
        return self._wire.listen(listener)

    @property
    def via(self) -> str:
        """Empty: this program drives the dish itself (`FaceSession`)."""
        return ""

    @property
    def detached(self) -> bool:
        """False: there is no other program (`FaceSession`)."""
        return False

    def step(self, seconds: float) -> None:
        """Run the station on this thread for so many seconds of its clock."""
        if self._thread is not None:
            raise BirdcageError("This session runs by itself: it was started.")
        if not self._begun:
            self._begun = True
            self.station.begin()
        self.station.step(self.clock.monotonic() + seconds)

    def _run(self) -> None:
        try:
            self.station.begin()
            self.station.step(math.inf)
        except BaseException as crash:  # noqa: BLE001 - whatever it is, the dish comes first
            # Kept for the face to tell: a traceback from this thread would land in the middle of its screen.
            self.crash = crash
            self.station.stop("a fault of birdcage")
        finally:
            self.station.shut()

    def bar(self) -> bool:
        """Let no line out that moves the dish from now on; return whether it may be moving. Any thread."""
        return self.station.bar()

    def leave(self, by: str) -> None:
        """STOP for a face that is about to end. Any thread; waits for nothing."""
        self.station.stop(by, leaving=True)

    def close(self, *, leave_moving: bool = False) -> str:
        """Send STOP if anything moves, give the port back, and return a sentence that says where the dish is.

        `leave_moving` sends no STOP: for a person who asked for a motion that outlives the program.
        """
        moving = not leave_moving and self.bar()
        if moving and self.crash is None:  # else STOP was called when it happened
            self.station.stop("quit", leaving=True)
            self._await_stop()
        self.station.end()
        if self._thread is None:
            self.station.shut()
        else:
            self._thread.join(SPEEDS_S if self.station.state.speeds_lent else QUIT_S)
        self._on_close()
        state = self.station.state
        return farewell(state.position, state.position_lost, self.station.stop_reach if moving else None)

    def _await_stop(self) -> None:
        """Give STOP the time to look where an unforeseen motion leads, and speeds theirs to be put back."""
        for waited in range(round(SPEEDS_S / SLICE_S)):
            looks = self.station.stop_reach.is_open and waited < LOOK_S / SLICE_S
            if not looks and not self.station.state.speeds_lent:
                return
            if self._thread is None:
                self.step(SLICE_S)
            elif self._thread.is_alive():
                self._thread.join(SLICE_S)
            else:
                return


def farewell(position: Pointing | None, lost: Reason | None, reach: StopReach | None) -> str:
    """Say where the dish is left; `reach` tells what became of STOP, None when there was nothing to stop."""
    if position is None or lost is not None:
        where = "The dish's position is not known."
    else:
        where = f"The dish was last seen at AZ {position.az_text} EL {position.el_deg:.2f}°, {position.utc:%H:%M:%S}Z."
    if reach is StopReach.SENT:
        return f"STOP was sent. {where}"
    if reach is StopReach.ENDS:
        return f"Nothing can stop this move; it ends by itself, and no other follows. {where}"
    if reach in (None, StopReach.AT_REST):
        return where
    if reach is StopReach.CHECKING:
        return f"No motion was under way. It is unknown whether the dish moves. {where}"
    return f"The dish may still be moving. No STOP has reached it: look at it, or cut its power. {where}"
