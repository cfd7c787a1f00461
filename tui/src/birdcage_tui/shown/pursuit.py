"""Which plan and which pursuit a frame shows. Pure functions of a view; nothing here imports numpy."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.station.pursuit_state import Phase, PointingSample, Pursuit

from birdcage_tui.shown.view import STALE_S, View

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.station.state import StationState
    from birdcage.tracking.plan import Incident, Plan

STEERED = frozenset({Phase.FOLLOWING, Phase.REWINDING, Phase.READY, Phase.PREPOSITIONING, Phase.PARKING})
"""Phases in which the pursuit moves the dish, or holds it in place to do so."""


def pursuit_of(state: StationState) -> Pursuit | None:
    """Return the pursuit under way; None when there is none, or it is over."""
    pursuit = state.pursuit
    return None if pursuit is None or pursuit.phase is Phase.OVER else pursuit


def plan_of(view: View) -> Plan | None:
    """Return the plan to draw: that of the chosen target; while none is chosen, the one being carried out."""
    chosen = None if view.track is None else view.track.plan
    pursuit = pursuit_of(view.state)
    if pursuit is not None and (chosen is None or same_target(chosen, pursuit.plan)):
        return pursuit.plan
    return chosen


def same_target(one: Plan, other: Plan) -> bool:
    """Return whether two plans are for one pass of one target."""
    if (one.aim.name, one.aim.norad_id) != (other.aim.name, other.aim.norad_id):
        return False
    if one.passing is None or other.passing is None:
        return one.passing is other.passing
    return abs((one.passing.tca - other.passing.tca).total_seconds()) < 60.0


def shown_is_followed(view: View) -> bool:
    """Return whether what is drawn is what the dish follows, or followed last: its looks belong to it."""
    pursuit, plan = view.state.pursuit, plan_of(view)
    return pursuit is not None and plan is not None and same_target(plan, pursuit.plan)


def sample_of(view: View) -> PointingSample | None:
    """Return the last look at how well the dish points; None unless it follows now."""
    pursuit = pursuit_of(view.state)
    if pursuit is None or pursuit.phase is not Phase.FOLLOWING:
        return None
    return view.followed[-1] if view.followed else pursuit.sample


def beam_of(view: View) -> Beam | None:
    """Return the beam at the frequency of the plan that is drawn; None if it is not known."""
    plan, beam = plan_of(view), view.state.beam
    return beam if beam is None or plan is None else beam.at(plan.aim.frequency_hz)


def target_place(view: View) -> tuple[float, float] | None:
    """Return where the target stands now, true degrees: by the plan, else where it was seen last.

    While the dish follows it, at the moment of the dish's own reading: the two differ by the error and no more.
    """
    plan, sample = plan_of(view), sample_of(view)
    if sample is not None and view.now - sample.at <= STALE_S and shown_is_followed(view):
        return sample.target_az_deg % 360.0, sample.target_el_deg
    t_s = view.utc.timestamp()
    if plan is not None and plan.sky.start_s <= t_s <= plan.sky.end_s:
        az_deg, el_deg = plan.sky.at(t_s)
        return az_deg % 360.0, el_deg
    if plan is not None or view.track is None or view.track.look is None:
        return None
    return view.track.look.az_deg, view.track.look.el_deg


def aimed_at(view: View) -> tuple[float, float] | None:
    """Return where the target stands that the dish follows now, true degrees; else where the dish was last sent.

    While it follows, it is sent ahead of the target: where it would come to rest is not the target.
    """
    pursuit, state = pursuit_of(view.state), view.state
    if pursuit is not None and pursuit.phase is Phase.FOLLOWING:
        sample = sample_of(view)
        if sample is not None and view.now - sample.at <= STALE_S:
            return sample.target_az_deg % 360.0, sample.target_el_deg
        az_deg, el_deg = pursuit.plan.sky.at(view.utc.timestamp())
        return az_deg % 360.0, el_deg
    if state.target_az_deg is None or state.target_el_deg is None:
        return None
    return state.target_az_deg, state.target_el_deg


LOADING = "Loading tracker …"
"""Why the pursuit desk shows nothing yet."""


def told_before_following(view: View) -> bool:
    """Return whether the dish follows a target, and has begun to after the last command was told of."""
    pursuit = pursuit_of(view.state)
    if pursuit is None or pursuit.phase is not Phase.FOLLOWING or not view.told:
        return False
    return (view.utc - view.told[-1].utc).total_seconds() > view.now - pursuit.since


def next_incident(view: View) -> Incident | None:
    """Return what happens next in the pursuit, whatever else is shown beside it."""
    pursuit = pursuit_of(view.state)
    if pursuit is None:
        return None
    t_s = view.utc.timestamp()
    return next((each for each in pursuit.plan.incidents if each.at_s > t_s and each.what != "tca"), None)


def to_true(view: View, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Return true degrees for some of the dish's own, by what the two differ where the dish points now.

    What a model of the mount changes over the sky is hundredths of a degree: less than a dot of the plot.
    """
    position = view.state.position
    if position is None:
        return az_deg + view.state.az_offset_deg, el_deg + view.state.el_offset_deg
    turn = (position.az_deg - position.dish_az_deg + 180.0) % 360.0 - 180.0
    return az_deg + turn, el_deg + position.el_deg - position.dish_el_deg
