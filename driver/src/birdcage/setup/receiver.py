"""Asking a GPS receiver on a thread of its own: it may take half a minute, and the setup never waits."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future

from birdcage.base.errors import BirdcageError

FIX_S = 30.0
"""How long a receiver is given."""

AskReceiver = Callable[[str, str | None], Future[object]]
"""Takes what a person calls the receiver, and the port of the dish, which is never opened; gives a `GpsFix`."""


def ask_receiver(receiver: str, dish_port: str | None) -> Future[object]:
    """Begin to ask; the future holds the fix, or a BirdcageError that says what was seen."""
    asked: Future[object] = Future()
    threading.Thread(target=_ask, args=(asked, receiver, dish_port), name="gps", daemon=True).start()
    return asked


def _ask(asked: Future[object], receiver: str, dish_port: str | None) -> None:
    from birdcage.base.clock import RealClock
    from birdcage.gps.locate import locate

    try:
        asked.set_result(locate(receiver, RealClock(), timeout_s=FIX_S, dish_port=dish_port))
    except BirdcageError as error:
        asked.set_exception(error)
    except Exception as error:  # noqa: BLE001 - whoever waits must hear of it, whatever it is
        asked.set_exception(BirdcageError(f"The receiver could not be asked: {error}"))
