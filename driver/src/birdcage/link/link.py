"""One open port, safe to write to from two threads, with everything that passes told to the transcript."""

from __future__ import annotations

import threading

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.port import Port
from birdcage.link.transcript import Transcript


class Link:
    """A `Port` around a `Port`: the same methods, every failure a `LinkError`, every byte in the transcript.

    The station thread reads and writes; STOP writes from whichever thread the key was pressed on. Writes are whole:
    one lock keeps the bytes of two of them from mixing, and keeps the transcript in the order of the wire.
    """

    def __init__(self, port: Port, clock: Clock, transcript: Transcript | None = None) -> None:
        self.name = port.name
        self.demo = port.demo
        self._port = port
        self._clock = clock
        self._transcript = transcript
        # Reentrant: a signal handler may call STOP on top of the write that it interrupted.
        self._writing = threading.RLock()
        self._closed = False
        if transcript is not None:
            transcript.begin(self.name, demo=self.demo, utc=clock.utc())

    def fileno(self) -> int | None:
        """Return the descriptor to select on, or None if there is none or the port is closed."""
        return None if self._closed else self._port.fileno()

    def pending(self) -> bool:
        """Return whether `read` has something to say, be it that the port is gone."""
        if self._closed:
            raise self._shut()
        try:
            return self._port.pending()
        except OSError as error:
            raise self._lost(error) from error

    def next_event(self) -> float | None:
        """Return when a simulated port becomes readable by itself, in monotonic seconds; None for a real one."""
        return self._port.next_event()

    def read(self) -> bytes:
        """Return all bytes that have arrived; LinkError (``lost``) once the port is gone."""
        if self._closed:
            raise self._shut()
        try:
            data = self._port.read()
        except OSError as error:
            raise self._lost(error) from error
        if data and self._transcript is not None:
            self._transcript.record("<", data, self._clock.utc())
        return data

    def write(self, data: bytes) -> None:
        """Send all of `data`, unmixed with another thread's; LinkError (``lost`` or ``failed``) if it can't leave."""
        with self._writing:
            if self._closed:
                raise self._shut()
            try:
                self._port.write(data)
            except OSError as error:
                raise self._lost(error) from error
            if data and self._transcript is not None:
                self._transcript.record(">", data, self._clock.utc())

    def remark(self, text: str) -> None:
        """Put a remark into the transcript; nothing goes to the dish."""
        if self._transcript is not None:
            self._transcript.remark(text, self._clock.utc())

    def discard(self) -> None:
        """Throw away output that has not left and input that was not read."""
        if self._closed:
            raise self._shut()
        try:
            self._port.discard()
        except OSError as error:
            raise self._lost(error) from error

    def close(self) -> None:
        """Give the port back; a second time does nothing, and a port that is gone closes as well."""
        with self._writing:
            if self._closed:
                return
            self._closed = True
            self._port.close()
        self.remark(f"closed {self.name}")

    def _shut(self) -> LinkError:
        return LinkError(f"{self.name} was closed by this program; connect again to use it.", reason=Reason.LOST)

    def _lost(self, error: OSError) -> LinkError:
        self.remark(f"lost {self.name}: {error}")
        return LinkError(
            f"{self.name} is gone: unplugged or closed at the other end. A motion may still go on. Look at the "
            "dish, then plug the adapter in again.",
            reason=Reason.LOST,
        )
