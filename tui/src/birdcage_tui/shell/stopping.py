"""STOP before everything else. The keys are caught on the thread that reads them, so no frame is in front of them."""

from __future__ import annotations

from textual.driver import Driver
from textual.events import Key, MouseDown
from textual.message import Message


def stop_first(base: type[Driver]) -> type[Driver]:
    """Return that driver with one thing added: the app's `keys` see each one as soon as it was read.

    Textual hands a key from its input thread to the event loop, where it waits for whatever frame is being painted.
    `Station.stop` may be called from any thread, and so it is, here.
    """

    class StopFirst(base):  # type: ignore[misc, valid-type]
        """Sees every key before the event loop does."""

        @property
        def unwritten(self) -> int:
            """How many pieces of output wait for a terminal that is slower than the app; 0 where nothing queues."""
            # Textual hands output to a thread of its own, and says nothing about how far that is.
            queue = getattr(getattr(self, "_writer_thread", None), "_queue", None)
            return 0 if queue is None else queue.qsize()

        def send_message(self, message: Message) -> None:
            keys = getattr(self._app, "keys", None)
            if isinstance(message, Key) and keys is not None:
                keys.read(message)
            elif isinstance(message, MouseDown) and keys is not None:
                keys.read_press(message)
            super().send_message(message)

    return StopFirst


def driver_for(base: type[Driver]) -> type[Driver]:
    """Return the platform's driver with STOP in front; ours, which bears bad terminals, in place of Textual's."""
    if base.__name__ != "LinuxDriver":
        return stop_first(base)
    from birdcage_tui.drawing.terminal import TerminalDriver

    return stop_first(TerminalDriver)
