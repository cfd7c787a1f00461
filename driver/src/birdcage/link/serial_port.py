"""Ports that pyserial opens: serial adapters, pseudo terminals, `rfc2217://` and `loop://`."""

from __future__ import annotations

import contextlib
import io
import select
import threading
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.exclusive import let_others_in

if TYPE_CHECKING:
    import serial

TERMINAL_ERRORS: tuple[type[Exception], ...] = ()
"""What flushing raises beside OSError; Windows has no such thing."""
with contextlib.suppress(ImportError):
    import termios

    TERMINAL_ERRORS = (termios.error,)

WRITE_TIMEOUT_S = 0.2
"""How long a write may wait for room in the system's buffer. Commands are short: waiting at all means a jammed port."""

DRAIN_S = 0.1
"""How long `close` lets the last bytes leave (a STOP, perhaps), before it throws them away."""

# DTR and RTS are never toggled by us: some boards restart and some adapters stop driving the pair when one falls. The
# kernel raises both when a port is opened, and drops both when it is closed if HUPCL is set, which it is on a fresh
# port. So each opening after the first would begin with a pulse; with HUPCL off, both stay as the first opening left
# them until the adapter is unplugged.


def leave_up(port: serial.Serial) -> None:
    """Say, before `port` is opened, that DTR and RTS are up: pyserial sets them as told, so they stay as they are."""
    port.dtr = True
    port.rts = True


def stay_up(port: serial.Serial) -> None:
    """Keep both lines up when the open `port` is closed later.

    Nothing happens on Windows, which drops them on closing whatever one says.
    """
    try:
        import termios

        descriptor = port.fileno()
    except (ImportError, io.UnsupportedOperation):
        return
    try:
        settings = termios.tcgetattr(descriptor)
        settings[2] &= ~termios.HUPCL
        termios.tcsetattr(descriptor, termios.TCSANOW, settings)
    except termios.error:
        return  # A port that is going away: the first read says so.


class SerialPort:
    """A `Port` over an open pyserial object, 8N1, without waiting."""

    demo = False

    def __init__(self, opened: serial.Serial, name: str, clock: Clock) -> None:
        self.name = name
        self._serial = opened
        self._clock = clock
        self._ahead = b""
        self._descriptor = _descriptor(opened)
        self._closed = False

    def fileno(self) -> int | None:
        """Return the descriptor; None on Windows and for URLs."""
        return self._descriptor

    def next_event(self) -> float | None:
        """Return None: when the dish will speak is unknown."""
        return None

    def pending(self) -> bool:
        """Return whether `read` will return bytes or tell that the port is gone."""
        if self._descriptor is not None:
            # A descriptor that hung up is always ready, while the count of waiting bytes stays 0.
            return bool(select.select([self._descriptor], [], [], 0)[0])
        if not self._ahead:
            # Reading is the only question to which a dead RFC 2217 connection gives an answer.
            self._ahead = self._serial.read(max(1, self._serial.in_waiting))
        return bool(self._ahead)

    def read(self) -> bytes:
        """Return all bytes that have arrived."""
        data, self._ahead = self._ahead, b""
        if self._descriptor is not None:
            return data + self._serial.read(65536)
        while chunk := self._serial.read(max(1, self._serial.in_waiting)):
            data += chunk
        return data

    def write(self, data: bytes) -> None:
        """Hand `data` to the system."""
        import serial

        try:
            self._serial.write(data)
        except serial.SerialTimeoutException as error:
            raise LinkError(
                f"{self.name} takes no more bytes. The dish may have missed the last command: "
                "unplug the adapter, plug it in again and reconnect.",
                reason=Reason.FAILED,
            ) from error

    def discard(self) -> None:
        """Flush both directions."""
        self._ahead = b""
        self._flush()

    def close(self) -> None:
        """Let the last bytes leave for at most 0.1 s, throw the rest away and close.

        Without the flush, closing an adapter that takes no bytes hangs in the kernel for up to 30 s.
        """
        if self._closed:
            return
        self._closed = True
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is None:
            # pyserial sleeps and joins its reader thread (up to 7 s) when it closes a network port.
            threading.Thread(target=self._serial.close, name="close port", daemon=True).start()
            return
        try:
            self._drain()
        except OSError:
            pass  # It is gone, and so are the bytes: there is only the descriptor to give back.
        finally:
            let_others_in(descriptor)
            self._serial.close()

    def _drain(self) -> None:
        until = self._clock.monotonic() + DRAIN_S
        while self._serial.out_waiting:
            if self._clock.monotonic() >= until:
                self._flush()
                return
            self._clock.wait(None, self._clock.monotonic() + 0.002)

    def _flush(self) -> None:
        try:
            self._serial.reset_output_buffer()
            self._serial.reset_input_buffer()
        except TERMINAL_ERRORS as error:
            raise OSError(*error.args) from error


def _descriptor(opened: serial.Serial) -> int | None:
    try:
        return opened.fileno()
    except io.UnsupportedOperation:
        return None
