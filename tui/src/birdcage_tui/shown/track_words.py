"""The pursuit in plain words: short, and as wide as their columns. Pure functions of a view."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.station.pursuit_state import Phase

from birdcage_tui.shown.pass_words import clock_text, count_text, length_text
from birdcage_tui.shown.pursuit import next_incident, pursuit_of, sample_of
from birdcage_tui.shown.resume_words import resume_words
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.pursuit.now import Unfinished
    from birdcage.station.pursuit_state import PointingSample, Pursuit
    from birdcage.tracking.day import Day
    from birdcage.tracking.plan import Incident, Plan

PHASE = {
    Phase.WAITING: "WAITING FOR",
    Phase.COUNTDOWN: "ABOUT TO MOVE TO",
    Phase.PREPOSITIONING: "GOING TO MEET",
    Phase.READY: "READY FOR",
    Phase.FOLLOWING: "FOLLOWING",
    Phase.REWINDING: "TURNING BACK FOR",
    Phase.YIELDED: "YIELDED, WAS ON",
    Phase.INTERRUPTED: "INTERRUPTED ON",
    Phase.PARKING: "PARKING AFTER",
    Phase.OVER: "OVER:",
}
STATUS = {
    Phase.WAITING: "WAIT", Phase.COUNTDOWN: "MOVES IN", Phase.PREPOSITIONING: "GO TO AOS", Phase.READY: "READY",
    Phase.FOLLOWING: "FOLLOW", Phase.REWINDING: "REWIND", Phase.YIELDED: "YIELDED", Phase.INTERRUPTED: "CUT OFF",
    Phase.PARKING: "PARKING", Phase.OVER: "IDLE",
}  # fmt: skip
"""One word for the status line."""
SHORT = {Phase.FOLLOWING: "FOLLOW", Phase.PREPOSITIONING: "TO MEET", Phase.REWINDING: "REWIND FOR",
         Phase.YIELDED: "YIELDED", Phase.INTERRUPTED: "CUT OFF", Phase.COUNTDOWN: "MOVES TO"}  # fmt: skip
"""The same where there is little room."""
NEXT = {"reach": "in reach", "pre-position": "moves", "follow": "follows", "park": "parks"}
"""What happens next (`Pursuit.next_what`), as a person says it before `in 02:43`."""

DEMO = "DEMO "
DAY_S = 86400.0
DRIFTS_DEG = 0.005
"""What moves less in a day stands still."""


def degrees(value_deg: float | None) -> str:
    """Return an error: `0.04°`, from ten degrees on `12.3°`; dashes when it is not known."""
    if value_deg is None:
        return "-.--°"
    return f"{value_deg:.2f}°" if value_deg < 9.995 else f"{value_deg:.1f}°"


def half_beam(beam: Beam) -> str:
    """Return how far half power lies off the middle: `2.8°`; of an ellipse `1.0° x 1.4°`, az x el."""
    across, up = beam.az_deg / 2, beam.el_deg / 2
    return f"{up:.1f}°" if f"{across:.1f}" == f"{up:.1f}" else f"{across:.1f}° x {up:.1f}°"


def decibels(value_db: float | None) -> str:
    """Return what is lost: `-0.01 dB`; dashes when the beam is not known."""
    if value_db is None:
        return "--.-- dB"
    return f"{-abs(value_db):.2f} dB" if abs(value_db) >= 0.005 else "0.00 dB"


def left_text(span_s: float) -> str:
    """Return how long is left, in words that no time of day looks like: `45 s`, `12 min`, `2h05`."""
    if span_s < 60.0:
        return f"{max(span_s, 0.0):.0f} s"
    return f"{span_s // 60.0:.0f} min" if span_s < 3600.0 else count_text(span_s)


def seconds_to(view: View, moment: datetime | None) -> float | None:
    """Return how long until then; None when that is not known."""
    return None if moment is None else (moment - view.utc).total_seconds()


def headline(view: View, *, brief: bool = False) -> str | None:
    """Return what the pursuit does to whom: `FOLLOWING METEOR-M2 4`; None without one."""
    pursuit = pursuit_of(view.state)
    if pursuit is None:
        return None
    word = SHORT.get(pursuit.phase, PHASE[pursuit.phase]) if brief else PHASE[pursuit.phase]
    if pursuit.phase is Phase.COUNTDOWN and pursuit.next_what == "park":
        word = "PARKS AFTER" if brief else "ABOUT TO PARK AFTER"
    return f"{word} {plain_name(pursuit.plan.aim.name)}"


def plain_name(name: str) -> str:
    """Return a target's name as lists and maps have it: that it is a demo stands in row 1."""
    return name.removeprefix(DEMO)


def live_words(view: View, *, brief: bool = False) -> str:
    """Return the error now, elements and all: `error 0.04°`, `error ±0.26°`; empty unless the dish follows."""
    sample, pursuit = sample_of(view), pursuit_of(view.state)
    if sample is None or pursuit is None:
        return ""
    found = live_deg(sample, pursuit.plan)
    about = "±" if pursuit.plan.elements is not None else ""
    words = "?" if found is None and brief else "unknown" if found is None else about + degrees(found)
    return f"{'err' if brief else 'error'} {words}"


def countdown_s(view: View) -> float | None:
    """Return the seconds until it moves without a fresh request; None unless it counts down."""
    pursuit = pursuit_of(view.state)
    if pursuit is None or pursuit.phase is not Phase.COUNTDOWN:
        return None
    return seconds_to(view, pursuit.next_at)


def countdown_words(view: View) -> str | None:
    """Return what is about to move, where to, and what stops it; None unless it counts down."""
    pursuit = pursuit_of(view.state)
    if pursuit is None or pursuit.phase is not Phase.COUNTDOWN:
        return None
    left_s = seconds_to(view, pursuit.next_at)
    when = "soon" if left_s is None else f"in {max(left_s, 0.0):.0f} s"
    return f"▲ MOVES{_where_to(pursuit)} {when}   Space cancels"


def _where_to(pursuit: Pursuit) -> str:
    """Return where it is about to move and for what: its park direction when the pass is over."""
    name, options, point = plain_name(pursuit.plan.aim.name), pursuit.options, pursuit.plan.preposition
    if pursuit.next_what == "park":
        if options.park_az_deg is None or options.park_el_deg is None:
            return f" to park after {name}"
        return f" to park at {options.park_az_deg:.0f}°/{options.park_el_deg:.0f}° after {name}"
    if pursuit.next_what == "follow" and pursuit.next_at is not None:
        az_deg, el_deg = pursuit.plan.sky.at(pursuit.next_at.timestamp())
        return f" to {az_deg % 360.0:.0f}°/{el_deg:.0f}° for {name}"
    return f" for {name}" if point is None else f" to {point.true_az_deg:.0f}°/{point.true_el_deg:.0f}° for {name}"


def trouble(view: View) -> tuple[str, str] | None:
    """Return ink and words for the row under the status line, where a pursuit wants to be noticed; else None."""
    words = countdown_words(view)
    if words is not None:
        return "warn-row", words
    pursuit, resume = pursuit_of(view.state), resume_words(view)
    if pursuit is not None and pursuit.phase is Phase.INTERRUPTED:
        return "warn-row", f"◌ PURSUIT INTERRUPTED  {pursuit.why}  {resume}".rstrip()
    found = None if view.track is None else view.track.resumable
    if found is not None and found.plan is not None and resume:
        did = "YIELDED" if pursuit is not None else "STOPPED"
        return "target-row", f"◌ {did} {_while(passes=found.plan.passing is not None)}.  {resume}"
    left = None if view.track is None or pursuit is not None else view.track.unfinished
    if left is not None:
        words = resume or f"{plain_name(left.name)}, {left_words(left)}."
        return "warn-row", f"▲ LEFT {_while(passes=left.reach_end is not None).upper()}  {words}"
    return None


def _while(*, passes: bool) -> str:
    return "in mid-pass" if passes else "while following"


def left_words(left: Unfinished) -> str:
    """Return until when what was left unfinished is in reach."""
    return "always up" if left.reach_end is None else f"in reach until {left.reach_end:%H:%M:%S}"


def _soon(word: str, left_s: float | None) -> str:
    what, comma, more = word.partition(", ")
    return word if left_s is None else f"{what} in {count_text(left_s)}{comma}{more}"


def _still_reached(incident: Incident, left_s: float, room: int) -> str:
    """Return for how long it is in reach yet, and where the target is then, as long as there is room for."""
    left, then = count_text(left_s), incident.text
    limit = then.partition(" the ")[2] or then
    shapes = [f"In reach for {left}, then {then}", f"In reach {left}, then {then.replace('the ', '')}",
              f"In reach {left}, then {limit}"]  # fmt: skip
    fits = [words for words in shapes if len(words) <= room and then != "ends"]
    return fits[0] if fits else f"In reach for {left}"


def next_words(view: View, room: int = 80) -> str:
    """Return what happens next and when, in about `room` columns; while it waits, what it waits for.

    `In reach for 02:43, then below the 18° floor`, `keyhole in 01:10, up to 2.6° off`.
    """
    pursuit = pursuit_of(view.state)
    if pursuit is None:
        return ""
    if pursuit.phase in (Phase.FOLLOWING, Phase.REWINDING, Phase.READY):
        if pursuit.plan.day is not None and pursuit.plan.day.standing:
            return pursuit.plan.day.standing
        coming = next_incident(view)
        if coming is not None and coming.what != "los":
            left_s = coming.at_s - view.utc.timestamp()
            return _still_reached(coming, left_s, room) if coming.what == "unreach" else _soon(coming.text, left_s)
    if not pursuit.next_what:
        return ""
    return _soon(NEXT.get(pursuit.next_what, pursuit.next_what), seconds_to(view, pursuit.next_at))


def los_words(plan: Plan) -> str:
    """Return when it sets; empty for what is always up."""
    if plan.passing is not None:
        return f"LOS {plan.passing.los:%H:%M:%S}"
    return "" if plan.day is None or plan.day.always_up else pass_words(plan)


def pass_words(plan: Plan) -> str:
    """Return rise, highest point and set as one line: `AOS 301° 03:21:10  TCA 64° 03:27:02  LOS 121° 03:32:50`.

    Of what does not pass, when it rises or sets, or how far it drifts.
    """
    passing = plan.passing
    if passing is None:
        return "always trackable while up" if plan.day is None else _day_words(plan.day, plan.sky.start_s)
    aos = "already up" if passing.already_up else f"AOS {passing.aos_azimuth_deg:.0f}° {passing.aos:%H:%M:%S}"
    los = "LOS later" if passing.still_up else f"LOS {passing.los_azimuth_deg:.0f}° {passing.los:%H:%M:%S}"
    return f"{aos}  TCA {passing.max_elevation_deg:.0f}° {passing.tca:%H:%M:%S}  {los}"


def _day_words(day: Day, t_s: float) -> str:
    event = day.horizon_s(t_s)
    if event is not None:
        return f"{event[0]} {clock_text(event[1], seconds=False)}"
    return drift_words(day) if day.always_up else ""


def drifts(day: Day) -> bool:
    """Return whether a target moves as much in a day as could be seen."""
    return max(day.az_drift_deg, day.el_drift_deg) >= DRIFTS_DEG


def drift_words(day: Day) -> str:
    """Return how far a target that is always up moves in a day: `drifts 0.12° az, 4.20° el a day`."""
    if not drifts(day):
        return "stands still in the sky"
    return f"drifts {day.az_drift_deg:.2f}° az, {day.el_drift_deg:.2f}° el a day"


def ahead_words(plan: Plan) -> str:
    """Return how far ahead the plan of what does not pass looks: `60 min`."""
    return f"{(plan.sky.end_s - plan.sky.start_s) / 60.0:.0f} min"


def reach_words(plan: Plan, room: int, at_s: float) -> str:
    """Return when it is in reach, as of a time: as many intervals as there is room for, then how long in all."""
    day, intervals = plan.day, plan.reach.intervals
    if day is not None and day.standing:
        return day.standing
    if day is not None and not day.never_in_reach:
        return _day_reach(day, at_s, room)
    if not intervals and plan.legs:
        return "always behind the horizon mask"
    if not intervals:
        reasons = ", ".join(plan.reach.words())
        never = "never in reach" if plan.passing is not None else f"out of reach for {ahead_words(plan)}"
        return f"{never}: {reasons}" if reasons else never
    total = length_text(plan.reach.total_s)
    spans = [f"{clock_text(one.start.timestamp())}-{clock_text(one.end.timestamp())}" for one in intervals]
    for count in range(len(spans), 0, -1):
        more = f" +{len(spans) - count}" if count < len(spans) else ""
        words = f"in reach {', '.join(spans[:count])}{more}, {total}"
        if len(words) <= room:
            return words
    return f"in reach {total}"


def _day_reach(day: Day, at_s: float, room: int) -> str:
    """Return when it is in reach in the hours to come: `in reach until 16:20, again tomorrow 12:03`."""
    up = "always up, " if day.always_up else ""
    spans = []
    for one in day.reach.intervals:
        start_s, end_s = one.start.timestamp(), one.end.timestamp()
        if end_s <= at_s:
            continue
        end = "" if end_s >= day.sky.end_s - 1.0 else clock_text(end_s, seconds=False)
        if start_s - 1.0 <= at_s:
            spans.append(f"until {end}" if end else "from now on")
            continue
        again = "again " if spans else ""
        tomorrow = "" if start_s // DAY_S == at_s // DAY_S else "tomorrow "
        start = clock_text(start_s, seconds=False)
        spans.append(again + tomorrow + (f"{start}-{end}" if end else start if again else f"from {start}"))
    if not spans:
        return f"{up}not in reach again within the day"
    words = f"{up}in reach {', '.join(spans)}"
    return words if len(words) <= room else f"{up}in reach {spans[0]}" + (f" +{len(spans) - 1}" if spans[1:] else "")


def expected_words(plan: Plan) -> tuple[str, tuple[str, ...]]:
    """Return ink and words of the error to believe, the longest first: with grade and age of the elements, and advice.

    `expected error ±0.26° (90 %: 2.2°)  ◐ usable elements, 24 h old`, down to `◐ 24 h old ±0.26°`.
    """
    from birdcage.sky.age_words import REENTERED, age_words
    from birdcage.tracking.pointing_error import element_words, error_words

    from birdcage_tui.shown.sky_picture import GRADE_INKS

    pointing, elements = plan.pointing, plan.elements
    words = "" if pointing is None else error_words(pointing)
    error = words and f"{'expected ' if words.startswith('±') else ''}error {words}"
    if elements is None:
        return "dim", (error, error.removeprefix("expected ")) if error else ()
    closest = elements.closest
    age = f"{closest.glyph} {age_words(closest.age_s)}"
    whole = f"{error}  {element_words(elements)}".strip()
    shapes = [whole, f"{age}, {error}" if error and closest.reentry is None else age]
    if pointing is not None and pointing.advice:
        shapes.insert(0, f"{whole}: {pointing.advice}")
    if closest.reentry is not None:
        shapes[-1] = f"{age}, {REENTERED}"
    elif pointing is not None and pointing.median is not None:
        about = f"±{degrees(pointing.median.rms_deg)}"
        shapes += [f"{closest.glyph} elements {age_words(closest.age_s)}, {about}", f"{age} {about}"]
    return GRADE_INKS[closest.grade], tuple(shapes)


def live_deg(sample: PointingSample, plan: Plan) -> float | None:
    """Return the error to believe now, as a rule; the dish's own where its plan knows of no other."""
    return sample.error_deg if plan.pointing is None else sample.expected_error_deg


def followed_words(pursuit: Pursuit) -> tuple[str, str]:
    """Return the error of what was followed so far, elements and all, and the dish's own; the first may be empty.

    `pass ±0.26° (90 %: 2.2°)` and `dish alone RMS 0.02°  max 0.05°`; without elements `RMS 0.02°  max 0.05°`.
    """
    from birdcage.sky.age_words import plus_minus

    dish = f"RMS {degrees(pursuit.rms_error_deg)}  max {degrees(pursuit.max_error_deg)}"
    pointing = pursuit.plan.pointing
    if pointing is None or pointing.elements is None:
        return "", dish
    what = "so far" if pursuit.plan.passing is None else "pass"
    return f"{what} {plus_minus(*pointing.with_dish(pursuit.rms_error_deg))}", f"dish alone {dish}"


def offset_words(view: View) -> str:
    """Return the time offset, and what it is in degrees where the target stands now: `offset +0.3 s = 0.18°`."""
    aim = None if view.track is None else view.track.aim
    if aim is None:
        return "offset --"
    offset_s = aim.time_offset_s
    return f"offset {offset_s:+.1f} s" + (f" = {degrees(abs(offset_s) * rate)}"
                                           if (rate := rate_deg_s(view)) is not None and offset_s else "")  # fmt: skip


def rate_deg_s(view: View) -> float | None:
    """Return how fast the target goes over the sky, in degrees a second: now, or where the pass is highest."""
    from birdcage.base.geometry import separation

    from birdcage_tui.shown.pursuit import plan_of

    plan = plan_of(view)
    if plan is None:
        return None
    t_s = view.utc.timestamp()
    if not plan.sky.start_s <= t_s < plan.sky.end_s - 1.0:
        t_s = (plan.sky.start_s + plan.sky.end_s) / 2 if plan.passing is None else plan.passing.tca.timestamp()
    return separation(*plan.sky.at(t_s), *plan.sky.at(t_s + 1.0))
