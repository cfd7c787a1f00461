"""Whether a receiver answers: one question, one deadline, nothing changed."""

from __future__ import annotations

import threading
import time

from birdcage.base.clock import RealClock
from birdcage.base.errors import BirdcageError
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.opening import caller
from birdcage.radio.rigctl import Rig


def ask_frequency(address: str, timeout_s: float = 1.0) -> float | None:
    """Return what the receiver at `address` is tuned to, in Hz; None where it answers and does not tell.

    ConfigError where that is no address, RadioLost where nobody answers in time.
    """
    where, call = caller(address, RealClock())
    told: list[float | BirdcageError | None] = []

    def ask() -> None:
        try:
            rig = Rig(call(timeout_s), time.monotonic, reply_s=timeout_s)
            try:
                told.append(rig.frequency_hz())
            finally:
                rig.close()
        except RadioRefused:
            told.append(None)
        except RadioLost as error:
            told.append(error)

    # Looking a name up has no deadline of its own: a thread that hangs there is left behind.
    asking = threading.Thread(target=ask, name="radio-probe", daemon=True)
    asking.start()
    asking.join(timeout_s)
    if not told:
        raise RadioLost(f"{where} has not answered within {timeout_s:g} s.")
    answer = told[0]
    if isinstance(answer, BirdcageError):
        raise answer
    return answer
