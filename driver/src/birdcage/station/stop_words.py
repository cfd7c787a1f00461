"""What STOP can do at this moment, and what to do where it can't: from rung, motion and machine, for every face.

Each line is exact in every state, or hedged; it has a form of at most `SHORT` columns.
"""

from __future__ import annotations

import math

from birdcage.rotator.facts import Facts
from birdcage.rotator.ladder import StopMeans
from birdcage.station.state import Activity, LinkPhase, Motion, StationState, StopReport, TvSearch

SHORT = 36
"""Columns that every line has a form for: the narrowest pane, at 40x12 and at 80x24."""
_AWAITED = {
    StopMeans.WAIT: "no STOP for this move: it ends by itself",
    StopMeans.NONE: "no STOP for this motion: it goes on",
    StopMeans.LOOK: "STOP looks where it goes",
    StopMeans.NOTHING_MOVED: "STOP checks that it is at rest",
    StopMeans.NO_LINK: "STOP DID NOT REACH IT",
    StopMeans.RELEASE: "motors released",
}
_LEAVES_IT = (StopMeans.WAIT, StopMeans.NONE)
_STOPPING = {
    StopMeans.WAIT: "STOP waits for the end of this move",
    StopMeans.LOOK: "STOP looks where the dish goes",
    StopMeans.NOTHING_MOVED: "STOP checks that it is at rest",
    StopMeans.RELEASE: "STOP releases the motors",
}


def power_switch(dish: Facts | None) -> str:
    """Return what to switch off where no STOP helps, as the dish calls its supply."""
    return "power switch" if dish is None else dish.power_switch


def is_stopping(state: StationState) -> bool:
    """Return whether STOP was called, and the dish was not seen at rest since."""
    return state.motion is None and state.activity is Activity.STOPPING


def awaited_words(state: StationState, stopped: StopReport) -> str:
    """Return what a STOP that is not confirmed yet has done, in a few words."""
    dish = state.dish
    if dish is not None and not dish.tells_at_rest and stopped.means is not StopMeans.NO_LINK:
        may = state.activity is not Activity.IDLE
        return "STOP can't be confirmed: it may still move" if may else "STOP can't be confirmed; over by its time"
    return _AWAITED.get(stopped.means, "STOP sent")


def stop_line(state: StationState, now: float, room: int | None = None) -> str:
    """Return what STOP can do now: the longest form that has room; without a limit, the longest there is."""
    forms = stop_forms(state, now)
    return forms[0] if room is None else fitting(forms, room)


def ends_motion(state: StationState) -> bool:
    """Return whether STOP is proven to end the present motion before it would end by itself."""
    if state.link.state is not LinkPhase.UP or is_stopping(state):
        return False
    if (motion := state.motion) is not None:
        return motion.stop_proven and motion.stop_power_s is not None and motion.stop_means not in _LEAVES_IT
    if state.activity not in (Activity.SLEWING, Activity.FOLLOWING, Activity.MOTOR_RUN):
        return False
    by = state.unplanned_stop
    return by not in _LEAVES_IT and _is_proven(state.dish, by)


def fitting(forms: tuple[str, ...], room: int) -> str:
    """Return the longest form that has room; any has room for the last one."""
    return next((words for words in forms if len(words) <= max(room, SHORT)), "")


def stop_forms(state: StationState, now: float) -> tuple[str, ...]:
    """Return the same thing in one form or more, the longest first; `now` is the station's monotonic time."""
    if state.link.state in (LinkPhase.CLOSED, LinkPhase.OPENING):
        return ("No STOP before the port is open",)
    if state.link.state is LinkPhase.LOST:
        return unreachable(state.dish)
    if state.link.state is not LinkPhase.UP:
        return _unsure(state.dish, "STOP may not reach the dish.")
    if is_stopping(state):
        return _stopping(state.dish, state.last_stop)
    if state.motion is not None:
        return _in_motion(state.dish, state.motion, now)
    return _without_plan(state)


def unreachable(dish: Facts | None) -> tuple[str, ...]:
    """Return that there is no way to the dish."""
    return and_else(
        dish, "STOP can't reach the dish. Switch off its {supply}.", "STOP can't reach it. Cut its {supply}."
    )  # fmt: skip


def and_else(dish: Facts | None, *forms: str) -> tuple[str, ...]:
    """Return lines with the dish's own supply and switch in their places."""
    switch = power_switch(dish)
    supply = switch.removesuffix(" switch")
    emergency = f"In an emergency, switch off its {supply}"
    return tuple(form.format(emergency=emergency, supply=supply, switch=switch) for form in forms)


def _unsure(dish: Facts | None, sentence: str) -> tuple[str, ...]:
    """Return that STOP may do nothing, and what then does."""
    return and_else(dish, f"{sentence} If it moves, switch off its {{supply}}.", "STOP may fail: use the {switch}")


def _in_motion(dish: Facts | None, motion: Motion, now: float) -> tuple[str, ...]:
    if motion.stop_means is StopMeans.WAIT:
        rests = motion.eta if motion.rests_at is None else motion.rests_at
        return (f"STOP at end of move, {max(0.0, rests - now):.0f} s",)
    if motion.stop_means is StopMeans.NONE or motion.stop_power_s is None:
        if motion.rests_at is None:
            ends = f"No STOP: it ends by itself in {max(0.0, motion.eta - now):.0f} s"
        else:  # at the latest
            ends = f"No STOP: it ends within {max(1, math.ceil(motion.rests_at - now))} s"
        return and_else(dish, f"{ends}. {{emergency}}.", ends)
    stops, takes = ("stops it", "takes") if motion.stop_proven else ("should stop it", "should take")
    if not motion.eta_known:
        return (f"STOP {stops}; how fast is unknown", f"STOP {stops}")
    tail = ", by motor release" if motion.stop_means is StopMeans.RELEASE else ""
    return (f"STOP {takes} {motion.stop_power_s:.1f} s{tail}",)


def _without_plan(state: StationState) -> tuple[str, ...]:
    """Return what STOP does to a dish that rests, or whose motion this program has not planned."""
    dish, activity, by = state.dish, state.activity, state.unplanned_stop
    latched = ("STOP is latched: no motion is sent",)
    unknown = and_else(dish, "No STOP is known for this dish. {emergency}.", "No STOP but the {switch}")
    match activity:
        case Activity.HOMING:
            none = and_else(dish, "Homing has no STOP. {emergency}.", "Homing: no STOP but the {switch}")
            return ("STOP ends the homing",) if dish is not None and dish.homing_stoppable else none
        case Activity.SWEEPING:
            return and_else(dish, "STOP sends a key; the sweep may go on to its end. {emergency}.",
                            "STOP may wait for the sweep's end")  # fmt: skip
        case Activity.INITIALIZING:
            return and_else(dish, "There is no STOP at start-up. {emergency}.", "No STOP but the {switch}")
        case Activity.IDLE if state.held is not None:
            return latched
        case _ if by is StopMeans.NONE:
            return unknown
        case Activity.UNKNOWN | Activity.IDLE if dish is not None and not dish.tells_at_rest:
            return ("STOP is sent; nothing confirms it",)
        case Activity.UNKNOWN if _acts(dish):
            return ("Motion unknown: STOP looks and acts",)
        case Activity.MOVING_UNASKED if state.search is TvSearch.RUNNING and dish is not None and dish.ends_search:
            return ("STOP ends the TV search",)
        case Activity.STOWING | Activity.MOVING_UNASKED | Activity.UNKNOWN:
            return _unsure(dish, "STOP may not hold the dish.")
        case Activity.SLEWING | Activity.FOLLOWING | Activity.MOTOR_RUN:
            if by is StopMeans.WAIT:
                return ("STOP at end of move",)
            return ("STOP brings it to rest" if _is_proven(dish, by) else "STOP should stop it",)
    return latched if state.held is not None else ("STOP holds it where it is",)


def search_ended(dish: Facts) -> str:
    """Return what a STOP that sent the line that ends a TV search has done, as a sentence with a blank behind it."""
    if dish.ends_search:
        return "The TV search was ended. "
    return "The line that may end a TV search was sent; whether it did is not known. "


def _acts(dish: Facts | None) -> bool:
    """Return whether a STOP that sees the dish move has something to send."""
    return dish is not None and any(rung.means.is_sent for rung in dish.stop_ladder)


def _is_proven(dish: Facts | None, by: StopMeans) -> bool:
    return dish is not None and any(rung.means is by and rung.proven for rung in dish.stop_ladder)


def _stopping(dish: Facts | None, stopped: StopReport | None) -> tuple[str, ...]:
    """Return what is awaited after a STOP; never that the dish is held before it is."""
    if stopped is None:
        return ("STOP called: not yet at rest",)
    if stopped.confirmed is False:
        return and_else(dish, "STOP is not confirmed. If the dish moves, switch off its {supply}.",
                        "STOP not confirmed: use {switch}")  # fmt: skip
    if stopped.means is StopMeans.NONE:
        return and_else(dish, "No STOP for this motion. {emergency}.", "No STOP but the {switch}")
    if stopped.means is StopMeans.NO_LINK:
        return and_else(dish, "STOP did not reach the dish. If it moves, switch off its {supply}.",
                        "STOP did not arrive. Cut its {supply}.")  # fmt: skip
    return (_STOPPING.get(stopped.means, "STOP sent: not yet at rest"),)
