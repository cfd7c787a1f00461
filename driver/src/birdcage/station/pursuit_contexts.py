"""Makes of a request to pursue what the pursuit is carried out by."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import attrgetter
from typing import TYPE_CHECKING

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.config import Settings
from birdcage.base.errors import MotionRefused
from birdcage.base.reason import Reason
from birdcage.rotator.own import with_speeds
from birdcage.station.state_store import StateStore

if TYPE_CHECKING:
    from birdcage.rotator.facts import Facts
    from birdcage.station.pursuit_state import PursuitOptions
    from birdcage.station.requests import Pursue
    from birdcage.station.state import StationState
    from birdcage.tracking.controller_input import Controller
    from birdcage.tracking.plan import Plan
    from birdcage.tracking.planning.bounds import PlanBounds
    from birdcage.tracking.pursuit_context import PursuitContext, StageNotice

_NO_MASK = Settings()
"""The horizon mask keeps the dish from nothing."""
BOUNDED_BY = (
    "dish", "alignment", "az_offset_deg", "el_min_deg", "el_max_deg", "cable_min_deg", "cable_max_deg", "turn",
    "no_go_sectors", "beam",
)  # fmt: skip
"""What of the station's state `bounds_of` goes by."""


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
    now = _DishNow(store, antenna)
    context = PursuitContext(
        request.plan, controller, now.model, now.bounds, hear, request.asked, park,
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


def bounds_of(state: StationState) -> PlanBounds:
    """Return what limits a plan of motion: axes, cable and sectors as they are now."""
    from birdcage.station.mounting import mount_of
    from birdcage.tracking.planning.bounds import PlanBounds

    return PlanBounds.of(mount_of(state, _NO_MASK))


class _DishNow:
    """The dish as it is now, worked out anew where something differs: a pursuit asks several times a command."""

    _bounded_by = attrgetter(*BOUNDED_BY)

    def __init__(self, store: StateStore, antenna: BirdcageAntenna) -> None:
        self._store, self._antenna = store, antenna
        self._of: tuple[object, ...] = ()
        self._bounds: PlanBounds | None = None
        self._kind: Facts | None = None
        self._speeds: Mapping[int, float] = {}
        self._model: Facts | None = None

    def model(self) -> Facts:
        """Return it without the speeds that a pursuit changes itself as it follows."""
        kind, speeds = self._antenna.kind, {**self._antenna.speeds_deg_s, **self._store.state.speeds_lent}
        if self._model is None or kind is not self._kind or speeds != self._speeds:
            self._kind, self._speeds, self._model = kind, speeds, with_speeds(kind, speeds)
        return self._model

    def bounds(self) -> PlanBounds:
        """Return what limits its motion."""
        state = self._store.state
        of = self._bounded_by(state)
        if self._bounds is None or of != self._of:
            self._of, self._bounds = of, bounds_of(state)
        return self._bounds
