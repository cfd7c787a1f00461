"""Makes of a request to pursue what the pursuit is carried out by."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.config import Settings
from birdcage.base.errors import MotionRefused
from birdcage.base.reason import Reason
from birdcage.rotator.own import with_speeds
from birdcage.station.state_store import StateStore

if TYPE_CHECKING:
    from birdcage.station.pursuit_state import PursuitOptions
    from birdcage.station.requests import Pursue
    from birdcage.tracking.controller_input import Controller
    from birdcage.tracking.plan import Plan
    from birdcage.tracking.planning.bounds import PlanBounds
    from birdcage.tracking.pursuit_context import PursuitContext, StageNotice


def refuse(plan: Plan, now_s: float) -> None:
    """Raise MotionRefused for a plan by which nothing can be followed: `unreachable`, `over`."""
    if plan.course is None or not plan.legs:
        why = plan.notes[0] if plan.notes else f"{plan.aim.name} is out of this dish's reach."
        raise MotionRefused(f"{why} Nothing was sent.", reason=Reason.UNREACHABLE)
    if plan.legs[-1].end_s <= now_s:
        raise MotionRefused(f"This pass of {plan.aim.name} is over. Nothing was sent.", reason=Reason.OVER)


def context_for(
    request: Pursue, store: StateStore, antenna: BirdcageAntenna, hear: Callable[[StageNotice], None]
) -> tuple[PursuitContext, str]:
    """Return it, and the name of the controller that steers. MotionRefused (`controller`) where that one must not."""
    from birdcage.tracking.pursuit_context import PursuitContext
    from birdcage.tracking.steering.choice import controller_for, lead_s

    options, gate = request.options, antenna.gate
    name, controller = controller_for(antenna.model, options.controller, velocity_allowed=options.velocity_allowed)
    park = None
    if options.at_end == "park" and options.park_az_deg is not None and options.park_el_deg is not None:
        park = antenna.alignment.to_dish(options.park_az_deg, options.park_el_deg)
    delay_s = antenna.rotator.line.delay_s
    beam, loss_db = store.state.beam, options.dead_band_db
    context = PursuitContext(
        request.plan, controller,
        # Without the speeds that it changes itself as it follows.
        lambda: with_speeds(antenna.kind, {**antenna.speeds_deg_s, **store.state.speeds_lent}),
        lambda: bounds_of(store), hear, request.asked, park,
        gate.cable_limits if gate.cable_deg is not None else None, options.dead_band_steps,
        beam.at(request.plan.aim.frequency_hz).error_deg(loss_db) if beam is not None and loss_db is not None else 0.0,
        lambda: antenna.rotator.line.answered, delay_s, lead_s(name, delay_s),
    )  # fmt: skip
    return context, name


def controller_that_suits(options: PursuitOptions, antenna: BirdcageAntenna) -> tuple[str, Controller]:
    """Return the controller that was asked for, or the one that suits the dish where that one must not steer it."""
    from birdcage.tracking.steering.choice import controller_for

    try:
        return controller_for(antenna.model, options.controller, velocity_allowed=options.velocity_allowed)
    except MotionRefused:
        return controller_for(antenna.model)


def bounds_of(store: StateStore) -> PlanBounds:
    """Return what limits a plan of motion: axes, cable and sectors as they are now."""
    from birdcage.station.mounting import mount_of
    from birdcage.tracking.planning.bounds import PlanBounds

    return PlanBounds.of(mount_of(store.state, Settings()))  # whose horizon mask keeps the dish from nothing
