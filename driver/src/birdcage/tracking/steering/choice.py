"""Which controller suits which dish."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from birdcage.base.errors import MotionRefused
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.tracking.controller_input import LEAD_S, Controller, ControllerInput
from birdcage.tracking.steering import fast, queued, whole
from birdcage.tracking.steering.leapfrogging import leapfrog
from birdcage.tracking.steering.velocity import PREPARES_S, velocity
from birdcage.tracking.steps import Steps


def _modelled(guide: ControllerInput) -> Steps:
    """Follow by the model of both axes alone, for a dish that does not tell its position.

    Where it stands is what it was sent to: nothing is read, and nothing shows a move that was lost.
    """
    if not guide.model.moves_one_axis:
        yield from whole.steer(guide)
        return
    yield from (queued.steer if guide.model.moves_in_turn else fast.steer)(guide, looks=False)


CONTROLLERS: Mapping[str, Controller] = MappingProxyType(
    {"fast": fast.fast, "velocity": velocity, "queued": queued.queued, "modelled": _modelled, "leapfrog": leapfrog}
)
"""By the names of `PursuitOptions.controller`."""


def suited(model: Facts) -> str:
    """Return the name of the controller that suits a dish. Never `leapfrog`, never `velocity`."""
    if not model.tells_at_rest:
        return "modelled"
    return "queued" if model.moves_in_turn else "fast"


def controller_for(model: Facts, wanted: str = "auto", *, velocity_allowed: bool = False) -> tuple[str, Controller]:
    """Return name and controller: the one that suits the dish (`auto`), or the one asked for.

    MotionRefused (`controller`) where the dish cannot be steered so, or the owner has not allowed it; KeyError for a
    name that no controller has.
    """
    name = suited(model) if wanted == "auto" else wanted
    refusal = _against(model, name, velocity_allowed=velocity_allowed)
    if refusal:
        raise MotionRefused(f"{refusal} Nothing was sent.", reason=Reason.CONTROLLER)
    return name, CONTROLLERS[name]


def lead_s(name: str, delay_s: float) -> float:
    """Return how long before the target comes into reach a controller takes over; `delay_s` as in `ControllerInput`."""
    return PREPARES_S + 2.0 * delay_s if name == "velocity" else LEAD_S


def _against(model: Facts, name: str, *, velocity_allowed: bool) -> str:
    dish = f"The {model.name}"
    if name in ("fast", "velocity") and model.moves_in_turn:
        return f"{dish} moves one axis at a time and would fall behind with the controller `{name}`; use `queued`."
    if name in ("fast", "velocity", "queued", "leapfrog") and not model.tells_at_rest:
        return f"{dish} does not tell its position; only the controller `modelled` steers it."
    if name == "velocity" and not model.has_speeds:
        return f"{dish} has no command for its speeds, which the controller `velocity` needs."
    if name == "velocity" and not velocity_allowed:
        return (
            "The controller `velocity` changes the greatest speed of the motors while it follows. That is unproven "
            "on a real dish. Set velocity_allowed = true in [tracking] to allow it."
        )
    return ""
