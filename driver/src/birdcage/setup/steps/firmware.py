"""Another firmware than the one that is spoken: a choice of the steps that find out which dish it is."""

from __future__ import annotations

from birdcage.base.config.edit import Value
from birdcage.base.errors import BirdcageError
from birdcage.base.machine_port import machine_at
from birdcage.base.reason import Reason
from birdcage.setup.context import SetupContext
from birdcage.setup.step import Choice
from birdcage.station.known import list_models

OTHER = "firmware-"
"""How the names of these choices begin."""
KEYS = ("f", "h", "e")


def other_firmwares(bench: SetupContext, *, likely: bool = False, heard: str = "", rate: int = 0) -> tuple[Choice, ...]:
    """Return a choice for each firmware that is known and not spoken now, the one that was `heard` first.

    Those of the rate at which something answers follow, then those that tell where they point. `likely` makes Enter
    take the first.
    """
    present = bench.state.dish
    others = [model for model in list_models() if present is None or model.firmware != present.firmware]
    others.sort(key=lambda model: (model.firmware != heard, rate not in (0, model.baud), not model.tells_at_rest))
    return tuple(
        Choice(f"{OTHER}{model.firmware}", key, f"It is a {model.name} ({model.firmware})")
        for key, model in zip(("enter", *KEYS) if likely else KEYS, others, strict=False)
    )


def speak_another(bench: SetupContext, firmware: str, port: str | None = None) -> None:
    """Keep a firmware, at its own rate, and the port where it was found. The session has to begin anew to speak it."""
    if bench.via:
        words = f"{bench.via} speaks to the dish. End it, and start it again with --firmware {firmware}."
        raise BirdcageError(f"{words} Nothing was changed.", reason=Reason.BUSY)
    keys: dict[str, Value] = {"dish.firmware": firmware, "dish.baud": None}
    if port is None and machine_at(bench.settings.dish.port) not in (None, firmware):
        port = bench.state.port  # the one that is kept names another machine
    if port is not None:
        keys |= {"dish.port": port, "link.usb_identity": None}
    bench.write(keys)
    for step in ("link", "dish"):
        bench.forget(step)  # what was kept of them was of another dish
    bench.begin_anew = firmware
