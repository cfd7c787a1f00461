"""What the dish does, what stops it, and what comes next, in plain words. Pure functions, like `words`."""

from __future__ import annotations

from birdcage.station.pursuit_state import Phase
from birdcage.station.state import Activity, LinkPhase

from birdcage_tui.shown.allowed import RESUME_KEY
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.resume_words import resume_words
from birdcage_tui.shown.state_words import tells_at_rest
from birdcage_tui.shown.stop_words import power_switch, searching, stop_text
from birdcage_tui.shown.track_words import PHASE, plain_name
from birdcage_tui.shown.unready import worst
from birdcage_tui.shown.view import View


def next_steps(view: View) -> list[tuple[str, str]]:
    """Return what it is doing, what stops it, and what comes next, as (ink, sentence) in that order."""
    state = view.state
    link = state.link.state
    if view.crash:
        return [
            ("fault-strong", "birdcage has failed. The values are old."),
            ("text", f"birdcage sends nothing more to the dish. In an emergency use the {power_switch(view)}."),
            ("text", "Press Ctrl+Q and start again."),
        ]
    if state.fault is not None:
        return [
            ("text", "birdcage sends no motion until you acknowledge the fault: Enter."),
        ]
    if link in (LinkPhase.CLOSED, LinkPhase.OPENING):
        return [
            ("text", f"Opening {state.port.split('?')[0] or 'the port'} and listening for the dish."),
            ("dim", "birdcage sends no motion. The position shows once the dish reports it."),
        ]
    finding = worst(view)
    in_pocket = "pocket" in view.scopes  # a finding's key works there where it has a brief form
    lack = (
        [] if finding is None else [(finding.ink, finding.plain if in_pocket and not finding.brief else finding.words)]
    )
    if link is LinkPhase.LOST and not state.port:
        return [("warn-strong", "No port set."), ("text", state.link.detail), *lack]
    if link in (LinkPhase.LOST, LinkPhase.SILENT):
        check = f"Check the cable, then the dish's {power_switch(view).removesuffix(' switch')}."
        return [
            *_unconfirmed_stop(view),
            ("text", check if link is LinkPhase.LOST else f"{check} birdcage asks again by itself."),
            ("dim", _until_then(view)),
        ]
    doing = _doing(view)
    steps = [doing] if doing[1] else []
    pursuit = pursuit_of(view.state)
    if view.moving and pursuit is None:  # what STOP does stands under the digits, which say whom it pursues
        steps.append(("text", f"Space: {stop_text(view, 80).removesuffix('.')}."))
    if state.held is not None:
        resume = resume_words(view, sentence=True)
        steps.append(
            ("text", f"birdcage sends no motion until you press Enter{f' or {RESUME_KEY}' if resume else ''}.")
        )
        if resume:
            steps.append(("text", f"{resume}."))
        if told := state.held_trouble or state.held.damage:
            steps.append(("warn", told))
    elif state.homed is False and state.activity is not Activity.HOMING:
        dish = state.dish
        if state.awaits_sync:
            steps.append(("text", "Next: look along it, then press Y to sync it: say where it points. Nothing moves."))
        elif dish is not None and dish.homing_s is None:
            steps.append(("text", "Next: switch the dish off and on. It homes by itself."))
        else:
            way = "turns through its whole range and runs into its end stops."
            steps.append(("text", f"To home, it {way}" if in_pocket else f"Next: H homes it. It {way}"))
    elif searching(view):
        steps.append(("text", "The search starts again at each power-up."))
    elif state.motion_refused_because:
        steps.append(
            ("text", "birdcage sends no motion. Fix the file, or press Enter to accept the dish's own limits.")
        )
    elif view.tour:  # the row under the status tells the other keys
        steps += [] if in_pocket else [("text", "2, c: details.")]
    elif pursuit is not None:
        steps.append(("text", f"{'' if in_pocket else '2, c: details. x there: end it. '}Arrows: take over."))
    elif state.dish is not None and state.dish.no_direction:
        pass  # the row under the status says what it lacks
    elif not view.moving:
        steps += lack
        lack = []
        arrows = "" if state.awaits_first_move else f", arrows step {view.step_deg:g}°"
        steps.append(("text", f"Next: g goes to a direction{arrows}."))
    steps += lack
    if view.clock is not None and view.clock.ink == "warn":
        steps.append((view.clock.ink, f"{view.clock.glyph} {view.clock.doubt}"))
        steps.append(("text", view.clock.cost))
    return steps


def _until_then(view: View) -> str:
    """Return what may move the dish before a person asks for it, while nothing can be said to it."""
    pursuit = pursuit_of(view.state)
    if view.state.held is None:
        return "birdcage sends no motion meanwhile."
    if pursuit is not None and pursuit.phase is Phase.INTERRUPTED and pursuit.options.resume:
        within_s = pursuit.options.resume_within_s
        return f"Back within {within_s:.0f} s, {pursuit.holder} goes on with {plain_name(pursuit.plan.aim.name)}."
    return "It stays held until you press Enter."


def _unconfirmed_stop(view: View) -> list[tuple[str, str]]:
    """Return what a STOP that did not get through, or that the dish did not follow, says of what is left to do."""
    stopped = view.state.last_stop
    if view.state.held is None or stopped is None or stopped.confirmed is not False:
        return []
    return [("warn-strong", stopped.sentence)]


def _doing(view: View) -> tuple[str, str]:
    state = view.state
    if state.held is not None and not view.moving and state.last_stop is not None:
        return "warn-strong", state.last_stop.sentence  # who holds it since when stands in row 2
    pursuit = pursuit_of(view.state)
    if pursuit is not None:
        word, name = PHASE[pursuit.phase].removesuffix(":"), plain_name(pursuit.plan.aim.name)
        return "accent-strong", pursuit.why or f"{word.capitalize()} {name}."
    if state.activity is Activity.SLEWING and state.motion is not None:
        skew = state.motion.to_skew_deg
        aim = f"{state.motion.to_az_deg:.2f}° / {state.motion.to_el_deg:.2f}°" if skew is None else f"skew {skew:.2f}°"
        who = state.holder or "somebody"
        return "accent-strong", f"{who.capitalize()} {'move' if who == 'you' else 'moves'} it to {aim}."
    if searching(view):
        return "fault-strong", "The TV search moves the dish. K ends it."
    if state.activity is Activity.MOVING_UNASKED:
        return "fault-strong", "The dish moves without a command: TV search, wind, or a hand."
    plain = _unplanned(view)
    if plain is not None:
        return "warn-strong", plain
    rests = "At rest."
    if not tells_at_rest(view):
        rests = "It does not tell if it moves." if state.position is None else "It should be at rest."
    if state.holder is None:
        return "strong", rests
    return "strong", f"{rests} {state.holder.capitalize()} {'have' if state.holder == 'you' else 'has'} control."


def _unplanned(view: View) -> str | None:
    """Return what a dish does that this program has not planned, or what is not known; None of one that rests."""
    state = view.state
    activity = state.activity
    if activity is Activity.HOMING:
        return f"Homing {state.activity_text}".rstrip() + "."
    if activity is Activity.STOWING:
        return "Stowing. No STOP is documented for it."
    if activity is Activity.SWEEPING:
        return f"It sweeps its {state.activity_text} by itself."
    if activity is Activity.INITIALIZING:
        return "The dish is starting."
    if activity is Activity.STOPPING:
        stopped = state.last_stop
        in_vain = stopped is not None and (stopped.confirmed is False or stopped.means == "none")
        return stopped.sentence if stopped is not None and in_vain else "Not seen at rest yet."
    if activity is Activity.MOTOR_RUN:
        return f"The {state.activity_text} motor runs while it is held."
    if activity in (Activity.SLEWING, Activity.FOLLOWING) or state.motion is not None:
        return "The dish is moving."
    if state.raw_motion:
        return "A raw line may move the dish. Its position is read when the console is idle."
    if state.homed is False:
        return ""  # row 2 says so, and what comes next is all there is to say
    return "Nothing read yet." if activity is Activity.UNKNOWN else None
