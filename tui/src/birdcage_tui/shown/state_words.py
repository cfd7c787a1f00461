"""The station's state in plain words. Pure functions: the same view gives the same sentence."""

from __future__ import annotations

from birdcage.base.config import feed_label
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopMeans
from birdcage.station.events import End, MoveEnded
from birdcage.station.state import Activity, LinkPhase, Pointing, TvSearch
from birdcage.station.task_state import TaskPhase

from birdcage_tui.shown.held_words import enter_words, held_words
from birdcage_tui.shown.pursuit import told_before_following
from birdcage_tui.shown.stop_words import power_switch, searching
from birdcage_tui.shown.track_words import headline, live_words, trouble
from birdcage_tui.shown.unready import worst
from birdcage_tui.shown.view import View

ACTIVITY = {
    Activity.UNKNOWN: "UNKNOWN",
    Activity.IDLE: "IDLE",
    Activity.SLEWING: "SLEWING",
    Activity.STOPPING: "STOPPING",
    Activity.HOMING: "HOMING",
    Activity.STOWING: "STOWING",
    Activity.SWEEPING: "SWEEPING",
    Activity.INITIALIZING: "STARTING",
    Activity.MOVING_UNASKED: "MOVES!",
    Activity.FOLLOWING: "FOLLOW",
    Activity.MOTOR_RUN: "MOTOR",
}
SEARCH = {
    TvSearch.RUNNING: "TV search RUNNING",
    TvSearch.OFF: "TV search off",
    TvSearch.OFF_UNTIL_POWER_UP: "TV search off until power-up",
    TvSearch.NONE: "TV search none",
    TvSearch.UNKNOWN: "TV search unknown",
}
LINK = {
    LinkPhase.CLOSED: ("○", "closed"),
    LinkPhase.OPENING: ("◌", "opening"),
    LinkPhase.UP: ("●", "up"),
    LinkPhase.SILENT: ("◍", "silent"),
    LinkPhase.LOST: ("○", "lost"),
}


LATE = "▲"
"""The link's glyph while it is up, and the dish owes an answer."""


def age_text(age_s: float) -> str:
    """Return an age in four columns or so: `0.2s`, `12s`, `3m`, `2h`."""
    if age_s < 9.95:
        return f"{max(age_s, 0.0):.1f}s"
    if age_s < 120:
        return f"{age_s:.0f}s"
    return f"{age_s / 60:.0f}m" if age_s < 7200 else f"{age_s / 3600:.0f}h"


def through(port: str, view: View) -> str:
    """Return a port, and the program that drives the dish there for this one: `/dev/ttyUSB0 via birdcage serve`."""
    return f"{port} via {view.via.partition(' (')[0]}" if view.via else port


def uncertainty_text(position: Pointing) -> str:
    """Return within how many degrees a modelled position should hold: `±0.4°`; empty of one that was read."""
    unsure_deg = position.uncertainty_deg
    if unsure_deg is None:
        return ""
    return f"±{unsure_deg:.0f}°" if unsure_deg >= 9.95 else f"±{max(unsure_deg, 0.1):.1f}°"


def span_text(span_s: float) -> str:
    """Return a time that passes as `mm:ss`, or `h:mm:ss`."""
    minutes, seconds = divmod(int(max(span_s, 0.0)), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes:02}:{seconds:02}"


def angle(value_deg: float | None, places: int = 2) -> str:
    """Return `231.07`, or dashes as wide as `places` asks for."""
    return ("-" * places + ".--") if value_deg is None else f"{value_deg:.2f}"


def tells_at_rest(view: View) -> bool:
    """Return whether the dish itself tells where it stands; taken for granted of one that is not known."""
    return view.state.dish is None or view.state.dish.tells_at_rest


def home_hint(view: View) -> str:
    """Return how a dish comes to know where it points, in a few words."""
    dish = view.state.dish
    if dish is not None and dish.must_be_synced:
        return "Y syncs it"
    if dish is not None and dish.homing_s is None:
        return "switch it off and on: it homes by itself"
    return "H homes it"


def unhomed_word(view: View) -> str:
    """Return what a dish is that does not know where it points."""
    return "NOT SYNCED" if view.state.awaits_sync else "NOT HOMED"


TOLD_DEG = 0.01
"""A miss of less is not told: angles are shown in hundredths."""
SETTLED_DEG = 0.05
"""A dish this near its target, when its time is over, only has to be seen at rest: tenths of a degree are shown."""


def motion_text(view: View) -> str:
    """Return what the dish is doing, in one short line."""
    state = view.state
    if view.waiting:
        return "Nothing read yet"
    if not view.link_up:
        return "MOVING when last heard" if view.moving else "UNKNOWN: the dish does not answer"
    pursued = headline(view)
    if pursued is not None and (state.motion is None or state.activity is Activity.FOLLOWING):
        return f"{pursued}  {live_words(view)}".rstrip()
    if state.motion is not None and state.activity is Activity.SLEWING:
        to_go_deg, left_s = view.to_go_deg, state.motion.eta - view.now
        going = "" if to_go_deg is None else f" {to_go_deg:.1f}° to go,"
        word = "SLEWING" if state.motion.to_skew_deg is None else "SKEW"
        if state.activity_text:
            return f"{word}: {state.activity_text}"
        if state.motion.az_way_deg is None:
            return f"{word}  direction shows in a moment"
        if not state.motion.eta_known:
            return f"{word}{going.rstrip(',')}"
        if left_s <= 0 and not tells_at_rest(view):
            return f"{word}{going.rstrip(',')}"  # it is over by its time, and only the proof of that is due
        if left_s <= 0 and to_go_deg is not None and to_go_deg < SETTLED_DEG:
            return f"{word}: settling"
        return f"{word}{going} {left_s:.1f} s" if left_s > 0 else f"{word}{going} overdue {-left_s:.1f} s"
    word = ACTIVITY[state.activity]
    if view.crash:
        return "UNKNOWN: birdcage has failed"
    if state.activity is Activity.IDLE:
        if state.fault is not None and state.motion is None:
            return "FAULT, at rest" if tells_at_rest(view) else "FAULT: it does not tell if it rests"
        rests = "IDLE, at rest" if state.position is not None else "IDLE, position unknown"
        misses = f", misses by {state.target_miss_deg:.2f}°" if state.target_miss_deg >= TOLD_DEG else ""
        if state.position is not None and state.position.modelled:
            rests = f"IDLE{misses}" if misses else "IDLE, should be at rest"
        else:
            rests += misses
        return rests if state.motion is None else "MOVING"
    if state.activity is Activity.UNKNOWN:
        if state.raw_motion:
            return "UNKNOWN since a raw line"
        return "UNKNOWN: nothing read yet" if tells_at_rest(view) else "UNKNOWN: it may still move"
    return f"{word} {state.activity_text}".rstrip()


def _tags(view: View, *shown: str) -> str:
    """Return the other things that are wrong, beside the one that the row tells."""
    state = view.state
    tags = [
        ("HELD", state.held is not None),
        ("FAULT", state.fault is not None),
        (unhomed_word(view), state.homed is False),
    ]
    return "".join(f"  + {word}" for word, on in tags if on and word not in shown)


def bad_day(view: View) -> tuple[str, str] | None:
    """Return the ink and the words of the row under the status line when something is wrong, else None."""
    state, link = view.state, view.state.link
    if view.crash:
        words = f"✖ BIRDCAGE FAILED  {view.crash}  The values are old. birdcage sends nothing more to the dish."
        return "fault-row", f"{words} Press Ctrl+Q and start again. In an emergency use the {power_switch(view)}."
    if (unstopped := _stop_lost(view)) is not None:
        return "fault-row", unstopped
    if (about_to := countdown_of_task(view)) is not None:
        return "warn-row", about_to
    if state.fault is not None:
        fault = state.fault
        words = f"✖ FAULT {fault.utc:%H:%M:%S}  {_stopped(fault.what)} {fault.meaning} {fault.remedy}"
        return "fault-row", f"{words}{enter_words(view, 'acknowledge')}{_tags(view, 'FAULT', unhomed_word(view))}"
    if link.state is LinkPhase.LOST and not state.port:
        return "warn-row", f"○ NO PORT  {link.detail}{_tags(view)}"
    if link.state is LinkPhase.LOST:
        trying = "" if state.port in link.detail else f"Trying {state.port.rsplit('/', 1)[-1]}. "
        told = f"{_last_seen(view)}{trying}{link.detail}"
        return "fault-row", f"○ LINK LOST {span_text(view.now - link.since)}  {told}{_tags(view)}"
    if link.state is LinkPhase.SILENT:
        return "warn-row", f"◍ SILENT {span_text(view.now - link.since)}  {_last_seen(view)}{link.detail}{_tags(view)}"
    if state.held is not None:
        return "warn-row", held_words(view) + _tags(view, "HELD")
    if state.motion_refused_because:
        accept = enter_words(view, "accept the dish's own limits")
        return "warn-row", f"▲ NO MOTION  {state.motion_refused_because}{accept}"
    if state.dish is not None and state.dish.no_direction and view.link_up:
        return "warn-row", f"▲ NO DIRECTION  {state.dish.no_direction}"
    if state.homed is False and state.activity is Activity.HOMING:
        return "warn-row", f"▲ NOT HOMED  Homing: it runs into its end stops. Only the {power_switch(view)} stops it."
    if state.homed is False:
        return "warn-row", f"▲ {unhomed_word(view)}  The dish does not know where it points.  {_homed_by(view)}"
    if state.position_lost is Reason.UNREADABLE and state.activity is not Activity.HOMING:
        where = "" if "pocket" in view.scopes else ": see F5"
        return "warn-row", f"▲ POSITION UNREADABLE  The position reply is unreadable{where}.  {_homed_by(view)}"
    pursued = trouble(view)
    if pursued is not None:
        return pursued
    if searching(view):
        return "warn-row", "▲ TV SEARCH RUNNING  It moves the dish.  K ends it until the next power-up"
    if view.late:
        return (
            "warn",
            f"{LATE} NO REPLY for {age_text(view.reply_age_s or 0.0)}  {_mute(view)}",
        )
    return None


def _stop_lost(view: View) -> str | None:
    """Return what is so where a STOP did not get through to the program that drives the dish; None where it did."""
    stopped = view.state.last_stop
    if not view.via or stopped is None or stopped.confirmed is not False or stopped.means is not StopMeans.NO_LINK:
        return None
    return f"✖ STOP DID NOT GET THROUGH  {stopped.sentence}"


def _mute(view: View) -> str:
    """Return what does not answer, as far as that is known here."""
    if view.via:
        return f"{view.via}, or the dish behind it, does not answer."
    return "The port is open; the dish does not answer."


TASKS = {"recovery": "HOMES after its restart", "park": "PARKS: no program has asked for a motion lately",
         "shelter": "PARKS"}  # fmt: skip
"""What the dish is about to do for a task that counts down, by its kind."""


def countdown_of_task(view: View) -> str | None:
    """Return what is about to move by itself, and what stops it; None unless a task counts down. Pursuits tell more."""
    task = next((each for each in view.state.tasks if each.phase is TaskPhase.COUNTDOWN), None)
    told_elsewhere = task is not None and task.kind == "pursuit" and view.state.pursuit is not None
    if task is None or told_elsewhere or task.next_at is None:
        return None
    left_s = max((task.next_at - view.utc).total_seconds(), 0.0)
    why = f"   {view.state.not_now}" if task.kind == "shelter" else ""
    return f"▲ {TASKS.get(task.kind, f'MOVES for the {task.kind}')} in {left_s:.0f} s{why}   Space cancels"


def _last_seen(view: View) -> str:
    position = view.state.position
    if position is None:
        return ""
    return "It was moving when last heard. " if view.moving else ""


def _homed_by(view: View) -> str:
    """Return how it comes to know where it points, as a sentence that is not broken after its key."""
    how = home_hint(view)
    for key in ("H homes", "Y syncs"):
        how = how.replace(key, key.replace(" ", "\N{NO-BREAK SPACE}"))
    return f"{how[:1].upper()}{how[1:]}."


def _stopped(words: str) -> str:
    return words if words.endswith((".", "!", "?")) else f"{words}."


def calm(view: View, *, brief: bool = False) -> str:
    """Return the line under the status when nothing is wrong; it may be empty. `brief`: in some 40 columns."""
    if view.tour:
        return view.tour
    if view.state.link.state is LinkPhase.OPENING:
        detail = view.state.link.detail or f"opening {view.state.port}"
        # A simulated dish has a long tail of options, which says nothing here.
        detail = detail.replace(view.state.port, view.state.port.split("?")[0])
        return f"{detail[:1].upper()}{detail[1:]} …"
    # The page's own last row tells it there.
    told = "" if "control" in view.scopes or told_before_following(view) else view.note
    later = view.state.not_now or view.state.warnings.get("outside", "")
    said = view.state.held_trouble or told or view.settings.notice or (f"▲ {later}" if later else "")
    return said or _standing(view, brief=brief)


def _standing(view: View, *, brief: bool) -> str:
    """Return what holds all the time and is easily forgotten: feed, offsets, place, clock; first a doubt."""
    state, place, clock = view.state, view.settings.place, view.clock
    doubt = "" if clock is None or clock.ink != "warn" else f"{clock.glyph} clock {clock.words}"
    finding = worst(view)
    if doubt and brief:
        return doubt.replace("doubtful: ", "")
    if brief and finding is not None and finding.brief:
        return finding.brief
    parts = [f"attached to {view.via}"] if view.via else []
    if state.feed_name:
        parts.append(feed_label(state.feed_name))
    if state.beam is not None:
        parts.append(f"beam {state.beam.size}")
    if state.az_offset_deg or state.el_offset_deg:
        parts.append(f"offset az {state.az_offset_deg:+.2f}° el {state.el_offset_deg:+.2f}°")
    if lean := state.alignment.lean_words():
        parts.append(lean)
    if place is not None and place.name:
        parts.append(place.name)
    if doubt:
        parts.insert(0, doubt)
    elif clock is not None and not brief:
        parts.append(f"clock {clock.words}")
    return "  ".join(parts)


def ended_text(event: MoveEnded) -> str:
    """Return how a motion ended, and where."""
    reason = f"{event.reason[:1].upper()}{event.reason[1:]}"
    position = event.position
    if event.end is End.NOT_TAKEN:
        reason = "The dish ignored the move and stands still"
        return reason if position is None else f"{reason} at {position.az_deg:.2f}°/{position.el_deg:.2f}°."
    if event.end is not End.ARRIVED or position is None:
        return reason
    skew = "" if position.skew_deg is None else f", skew {position.skew_deg:.2f}°"
    miss = f", {event.miss_deg:.2f}° off" if event.miss_deg >= TOLD_DEG else ""
    if position.modelled:
        there = f"{position.az_deg:.2f}°/{position.el_deg:.2f}°"
        return f"It should have arrived at {there}{miss}. At rest the dish does not tell."
    return f"{reason} at {position.az_deg:.2f}°/{position.el_deg:.2f}°{skew}{miss}."
