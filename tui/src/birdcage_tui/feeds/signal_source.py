"""The signal sources of a session: the dish's own tuner, and the receiver, which the pursuit desk tunes in a pass."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.signal.monitor import SignalMonitor
    from birdcage.signal.receiver import ReceiverSource
    from birdcage.signal.source import Hear
    from birdcage.station.access import FaceSession


class SessionSignals:
    """Made when they are first asked for: the app after its first frame, or the desk on a thread of its own."""

    def __init__(
        self, session: FaceSession, settings: Settings, load: Callable[[], Settings], *, threads: bool = True
    ) -> None:
        """`load` reads the settings again. `threads=False`: a test calls the receiver's `step`."""
        self._session, self._settings, self._load, self._threads = session, settings, load, threads
        self._lock = threading.Lock()
        self._receiver: ReceiverSource | None = None
        self._monitor: SignalMonitor | None = None

    @property
    def receiver(self) -> ReceiverSource:
        """The receiver beside the dish; the monitor hears it from then on. Any thread."""
        with self._lock:
            if self._receiver is None:
                from birdcage.signal.receiver import ReceiverSource

                clock = self._session.clock
                self._receiver = ReceiverSource(self._session.station, self._settings, clock, threads=self._threads)
                if self._monitor is not None:
                    self._monitor.add(self._receiver)
            return self._receiver

    def monitor(self, hear: Hear) -> SignalMonitor:
        """Return what reads the source that the feed names. A receiver is loaded once it, or the desk, wants one."""
        from birdcage.signal.monitor import SignalMonitor
        from birdcage.signal.tuner import TUNER, TunerSource

        chosen = self._settings.active_feed.signal
        receiver = None if chosen == TUNER else self.receiver
        with self._lock:
            receiver = receiver or self._receiver
            tuner = TunerSource(self._session.station)
            self._monitor = SignalMonitor([tuner] if receiver is None else [tuner, receiver], chosen, hear)
            return self._monitor

    def chosen_now(self) -> str:
        """Read the settings again, and return the id of the source that the mounted feed names."""
        self._settings = self._load()
        self.receiver.use(self._settings)
        return self._settings.active_feed.signal
