"""DTR and RTS: never toggled by us, as some boards restart and some adapters stop driving the pair when one falls.

The kernel raises both when a port is opened, and drops both when it is closed if HUPCL is set, which it is on a fresh
port. So each opening after the first would begin with a pulse; with HUPCL off, both stay as the first opening left
them until the adapter is unplugged.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import serial


def leave_up(port: serial.Serial) -> None:
    """Say, before `port` is opened, that both lines are up: pyserial sets them as told, so they stay as they are."""
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
