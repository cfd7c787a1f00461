"""`w`: one harmless line for the dish's own console, whose control goes back at once."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from typing import Any

from birdcage.rotctld.client_tuner import refusal
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.station.access import StationAccess
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import AcquireLease, Raw, ReleaseLease


def send_line(station: StationAccess, holder: str, line: str) -> Future[Sequence[str]]:
    """Send it, and return the lines of the answer. ERJCTED for any line that is not harmless, or while it moves.

    The console is asked for as a person asks for it (F5), and so takes control; `holder` has it again afterwards if it
    had it before. A person who takes control meanwhile keeps it.
    """
    told: Future[Sequence[str]] = Future()
    state = station.state
    if state.holder not in (None, holder):
        raise RotctldError(Rprt.ERJCTED, f"{state.holder} has control of the dish.")
    had_control = state.holder == holder
    if had_control:
        station.submit(AcquireLease(CONSOLE, take_over=True))

    def answered(asked: Future[object]) -> None:
        station.submit(ReleaseLease(CONSOLE))
        if had_control:
            station.submit(AcquireLease(holder))
        if error := asked.exception():
            told.set_exception(refusal(error))
        else:
            reply: Any = asked.result()
            told.set_result(reply.lines)

    station.submit(Raw(line)).add_done_callback(answered)
    return told
