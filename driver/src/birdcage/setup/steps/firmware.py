"""Another firmware than the one that is spoken: a choice of the steps that find out which dish it is."""

from __future__ import annotations

from birdcage.base.errors import BirdcageError
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


def speak_another(bench: SetupContext, choice: str) -> None:
    """Keep the firmware of that choice, at its own rate. The session has to begin anew to speak it."""
    firmware = choice.removeprefix(OTHER)
    if bench.via:
        words = f"{bench.via} speaks to the dish. End it, and start it again with --firmware {firmware}."
        raise BirdcageError(f"{words} Nothing was changed.", reason=Reason.BUSY)
    bench.write({"dish.firmware": firmware, "dish.baud": None})
    for step in ("link", "dish"):
        bench.forget(step)  # what was kept of them was of another dish
    bench.begin_anew = firmware
