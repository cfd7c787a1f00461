"""FTDI's latency timer: the chip holds a short answer back for 16 ms, unless told not to.

A position query is a short answer, so the timer is most of its round trip. Linux shows it as `latency_timer` in sysfs
and sets it to 1 ms for whoever has the port open and asks for low latency.
"""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import serial

SYS = Path("/sys")


def latency_ms(device: str, sys: Path = SYS) -> int | None:
    """Return how long the adapter holds bytes back; None if it has no such timer (no FTDI chip, no Linux)."""
    with contextlib.suppress(OSError, ValueError):
        name = Path(device).resolve().name
        return int((sys / "class" / "tty" / name / "device" / "latency_timer").read_text())
    return None


def lower_latency(port: serial.Serial, device: str, sys: Path = SYS) -> str | None:
    """Ask the open `port` for low latency where there is a timer; return a remark for the transcript, None if not."""
    before = latency_ms(device, sys)
    if before is None:
        return None
    try:
        port.set_low_latency_mode(True)
    except (ValueError, NotImplementedError) as error:
        # The system may forbid it, or a container hide it. All works without, each answer 16 ms later.
        return f"FTDI latency timer {before} ms, low latency refused: {error}"
    return f"FTDI latency timer {before} ms before, {latency_ms(device, sys)} ms now"
