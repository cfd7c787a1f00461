"""What stalls, failed homings, drivers and wear say of the motors, and of what stands in their way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import UTC, datetime, timedelta

from birdcage.base.geometry import shortest_turn
from birdcage.base.journal_rows import IncidentKind, JournalEntry
from birdcage.diagnostics.examination import Examination
from birdcage.diagnostics.finding import Finding, Urgency
from birdcage.diagnostics.wording import at_angles, axis_word, clock, how_often, many, on, times
from birdcage.rotator.feature import DRIVER
from birdcage.station.state import FaultReason

SAME_DEG = 2.0
"""Stalls so near to one another are at the same place: a dish coasts, and is read every tenth of a second."""
ONE_SPELL = timedelta(hours=6)
"""Stalls of an axis within this had the same cause, if it had none before or after: frost on one morning."""
OVER = timedelta(hours=24)
"""For so long there must be none after them, or they may go on."""
WIDE_DEG = 10.0
"""Stalls this far apart are not at one place."""
TURN_DEG = 360.0
MUCH_TURNS, MUCH_MORE = 50.0, 3.0
"""So many turns in the days that are judged, and so many times those before them, are told as wear."""


def failed_homing(seen: Examination) -> Iterator[Finding]:
    """An axis that did not find its reference: its angles mean nothing until it does."""
    for axis, faults in _by_axis(seen.of_reason(FaultReason.STALL, homing=True)):
        name = f"homing.{axis or 'unknown'}"
        last, word = faults[-1].utc, axis_word(axis)
        remedies = {} if seen.facts is None else seen.facts.handling.home_remedies
        todo = [remedies.get(axis) or f"Cut its power. Find what blocks {word if axis else 'it'}, and free it."]
        if axis not in remedies:
            todo.append(seen.home_it)
        if seen.facts is not None and seen.facts.handling.stow_by_hand:
            todo.append(seen.facts.handling.stow_by_hand)
        moments = [each.utc for each in faults]
        if _has_homed_since(seen, axis, last):
            yield Finding(
                name, Urgency.WILL_STOP,
                f"{word} failed to home {how_often(moments, seen.now)}. Since then it has homed without that.",
                "What kept it from its reference may do so again.", tuple(todo), moments[0], last, len(faults),
            )  # fmt: skip
            continue
        yield Finding(
            name, Urgency.HURTS, f"{word} failed to home {how_often(moments, seen.now)}.",
            "It lost its reference, so its angles mean nothing: a move may run it into its stop.",
            ("Move nothing until it has found its reference.", *todo), moments[0], last, len(faults),
        )  # fmt: skip


def _has_homed_since(seen: Examination, axis: str, then: datetime) -> bool:
    """Return whether an axis was homed since, or a dish has started that homes by that. An angle proves nothing.

    Of an axis that is not known, all have to be.
    """
    boot = timedelta(seconds=seen.facts.boot_s if seen.facts is not None else 0.0)
    homed = {
        name for each in seen.history.recent_incidents(IncidentKind.HOMED) if each.utc > then
        for name in each.sentence.split(", ")
    }  # fmt: skip
    every = set() if seen.facts is None else {each.name for each in seen.facts.numbered.values()}
    needed = {axis} if axis else every
    started = seen.history.recent_incidents(IncidentKind.RESTART, IncidentKind.START)
    homes_itself = seen.facts is not None and seen.facts.homing_s is None
    # The boot text of the start in which it failed may come behind the failure.
    return (bool(needed) and needed <= homed) or (homes_itself and any(each.utc > then + boot for each in started))


def stalls(seen: Examination) -> Iterator[Finding]:
    """Axes that were kept from turning. Where and when they stalled tells by what, most likely."""
    found = seen.of_reason(FaultReason.STALL)
    for axis, faults in _by_axis(found):
        if (here := _at_one_place(axis, faults)) is not None:
            yield _obstructed(seen, axis, faults, here)
        elif _are_one_spell(seen, faults, found) and _has_moved_since(seen, axis, faults[-1].utc):
            yield _in_one_spell(seen, axis, faults)
        elif _are_everywhere(axis, faults):
            yield _worn(seen, axis, faults)
        else:
            yield _stalled(seen, axis, faults)


def _are_one_spell(seen: Examination, faults: Sequence[JournalEntry], found: Sequence[JournalEntry]) -> bool:
    """Return whether the stalls of an axis lie close together, and with more than one of any axis; and are over."""
    first, last = faults[0].utc, faults[-1].utc
    near = [each for each in found if last - ONE_SPELL <= each.utc <= first + ONE_SPELL]
    return last - first <= ONE_SPELL and len(near) > 1 and seen.now - last >= OVER


def _has_moved_since(seen: Examination, axis: str, then: datetime) -> bool:
    """Return whether an axis was sent on a later UTC day: wear is kept by day."""
    numbered = {} if seen.facts is None else seen.facts.numbered
    tomorrow, end = then.astimezone(UTC).date() + timedelta(days=1), seen.now.astimezone(UTC).date()
    return any(
        seen.history.worn(number, tomorrow, end + timedelta(days=1)).moves
        for number, each in numbered.items() if each.name == axis
    )  # fmt: skip


def _stalled(seen: Examination, axis: str, faults: Sequence[JournalEntry]) -> Finding:
    todo = (
        "Look at the dish: the cable by its arm, ice, something in its way. Cut its power before you touch it.",
        "Free it.",
        seen.home_it,
    )
    return _finding(
        axis, faults, _fresh(seen, faults), f"{_what(seen, axis, faults)}{_where(axis, faults)}.",
        "Something blocked it, or its motor lost steps. Its angles may be wrong since.", todo,
    )  # fmt: skip


def _obstructed(seen: Examination, axis: str, faults: Sequence[JournalEntry], here: list[JournalEntry]) -> Finding:
    place = round(_middle(axis, here))
    place = place % round(TURN_DEG) if axis == "azimuth" else place
    others = len(faults) - len(here)
    rest = f" It stalled {times(others)} elsewhere, too." if others else ""
    heights = ""
    if axis == "azimuth" and (levels := [each.el_deg for each in here if each.el_deg is not None]):
        low, high = round(min(levels)), round(max(levels))
        heights = f", elevation {low}°" if low == high else f", elevation {low}° to {high}°"
    todo = (
        f"Cut its power, and look at what the dish meets at {axis} {place}°{heights}: a branch, a cable, ice.",
        "Take it away.",
        seen.home_it,
        "If it has to stay, forbid the way there: `motion.no_go_sectors` in birdcage.toml, or the limits on F8.",
    )
    return _finding(
        axis, faults, _fresh(seen, faults),
        f"{_what(seen, axis, here)}, each time at {place}°. Something probably stands in its way there.",
        f"Stalls at one place mean an obstacle.{rest} Its angles may be wrong since.", todo,
    )  # fmt: skip


def _in_one_spell(seen: Examination, axis: str, faults: Sequence[JournalEntry]) -> Finding:
    first, last = faults[0].utc, faults[-1].utc
    between = clock(first) if first == last else f"{first:%H:%M} to {clock(last)}"
    return _finding(
        axis, faults, Urgency.WILL_STOP,
        f"{axis_word(axis)} stalled {times(len(faults))} {on(first, seen.now)}, {between}, and not since.",
        "All of it was in one spell: ice or snow, if it was cold, or something that has gone since.",
        (
            "After a cold night, look for ice before the first move.",
            f"If satellites are off since then, its angles are wrong. {seen.home_it}",
        ),
    )  # fmt: skip


def _worn(seen: Examination, axis: str, faults: Sequence[JournalEntry]) -> Finding:
    return _finding(
        axis, faults, Urgency.STOPS if seen.is_recent(faults[-1].utc) else Urgency.WILL_STOP,
        f"{_what(seen, axis, faults)}{_where(axis, faults)}: at no one place.",
        "So it is not one obstacle. A worn belt or gear, a stiff bearing or a weak supply makes an axis lose steps.",
        (
            f"Keep clear, move {axis_word(axis)} all the way in small steps, and listen: where does it grind or halt?",
            "Cut its power, and look at its belt and gears: worn teeth, slack, grit. Tighten, clean or replace them.",
            "Then measure the voltage at the dish while both axes move: it must not dip.",
            seen.home_it,
        ),
    )  # fmt: skip


def _finding(
    axis: str, faults: Sequence[JournalEntry], urgency: Urgency, text: str, why: str,
    todo: tuple[str, ...],
) -> Finding:  # fmt: skip
    return Finding(
        f"stall.{axis or 'unknown'}", urgency, text, why, todo, faults[0].utc, faults[-1].utc, len(faults)
    )  # fmt: skip


def _fresh(seen: Examination, faults: Sequence[JournalEntry]) -> Urgency:
    if seen.is_recent(faults[-1].utc):
        return Urgency.HURTS
    return Urgency.WILL_STOP if len(faults) > 1 else Urgency.NOTE


def _what(seen: Examination, axis: str, faults: Sequence[JournalEntry]) -> str:
    return f"{axis_word(axis)} stalled {how_often([each.utc for each in faults], seen.now)}"


def _where(axis: str, faults: Sequence[JournalEntry]) -> str:
    words = at_angles(_angles(axis, faults), turns=axis == "azimuth")
    return f", {words}" if words else ""


def _angle(axis: str, fault: JournalEntry) -> float | None:
    return {"azimuth": fault.az_deg, "elevation": fault.el_deg}.get(axis)


def _angles(axis: str, faults: Sequence[JournalEntry]) -> list[float]:
    return [angle for each in faults if (angle := _angle(axis, each)) is not None]


def _apart(axis: str, one: float, other: float) -> float:
    return abs(shortest_turn(one, other)) if axis == "azimuth" else abs(one - other)


def _at_one_place(axis: str, faults: Sequence[JournalEntry]) -> list[JournalEntry] | None:
    """Return the stalls at the place where most of them were; None where that is not half of them, or one alone."""
    best: list[JournalEntry] = []
    for centre in _angles(axis, faults):
        near = [
            each for each in faults
            if (angle := _angle(axis, each)) is not None and _apart(axis, centre, angle) <= SAME_DEG
        ]  # fmt: skip
        best = max(best, near, key=len)
    return best if len(best) > 1 and 2 * len(best) >= len(faults) else None


def _are_everywhere(axis: str, faults: Sequence[JournalEntry]) -> bool:
    angles = _angles(axis, faults)
    days = {each.utc.date() for each in faults}
    return len(angles) > 2 and len(days) > 1 and max(_apart(axis, angles[0], each) for each in angles) > WIDE_DEG


def _middle(axis: str, faults: Sequence[JournalEntry]) -> float:
    angles = _angles(axis, faults)
    first = angles[0]
    ways = [shortest_turn(first, each) if axis == "azimuth" else each - first for each in angles]
    middle = first + sum(ways) / len(ways)
    return middle % TURN_DEG if axis == "azimuth" else middle


def _by_axis(faults: Sequence[JournalEntry]) -> list[tuple[str, list[JournalEntry]]]:
    """Return faults by axis, the one with most of them first."""
    axes: dict[str, list[JournalEntry]] = {}
    for each in faults:
        axes.setdefault(each.axis, []).append(each)
    return sorted(axes.items(), key=lambda item: -len(item[1]))


def drivers(seen: Examination) -> Iterator[Finding]:
    """A motor's driver that reports a fault now."""
    if seen.facts is None:
        return
    for feature in seen.facts.features.values():
        reading, mark = seen.reading(feature.id), feature.health
        if reading is None or mark is None or mark.is_good(reading.value) is not False:
            continue
        if feature.id.split(".")[0] != DRIVER:
            continue
        yield Finding(
            feature.id, Urgency.STOPS,
            f"The driver of the {axis_word(feature.id.split('.')[-1])} motor reports {reading.value}.",
            "That motor may not turn, or not hold the dish. Its driver is too hot, shorted, or has lost its motor.",
            (
                f"Cut the power at the {seen.switch}, and let it cool for ten minutes.",
                "Check the motor's plug and wires.",
                "Switch it on. If the fault comes back, the motor or its driver is broken.",
                seen.home_it,
            ),
            lasts=True,
        )  # fmt: skip


def wear(seen: Examination) -> Iterator[Finding]:
    """An axis that turned much more than in the days before."""
    if seen.facts is None:
        return
    begin, end = seen.history.span
    before = begin - timedelta(days=seen.history.days)
    for number, axis in seen.facts.numbered.items():
        turns = seen.history.worn(number, begin, end).degrees / TURN_DEG
        earlier = seen.history.worn(number, before, begin).degrees / TURN_DEG
        if turns < MUCH_TURNS or not earlier or turns < MUCH_MORE * earlier:
            continue
        yield Finding(
            f"wear.{axis.name}", Urgency.NOTE,
            f"{axis_word(axis.name)} turned {many(round(turns), 'turn')} in {seen.history.days} days, "
            f"{turns / earlier:.0f} times as much as in the {seen.history.days} days before.",
            "Belts, gears, motors and the cable through the base wear with each turn.",
            ("Look at belt and cable once. `birdcage status` tells what each axis has done in all.",),
            seen.history.begin, grade=float(int(turns / earlier)),
        )  # fmt: skip


def moved_unasked(seen: Examination) -> Iterator[Finding]:
    """A dish that moved though nothing was sent."""
    faults = seen.of_reason(FaultReason.MOVED)
    if faults:
        moments = [each.utc for each in faults]
        yield Finding(
            "moved", _fresh(seen, faults), f"The dish moved unasked {how_often(moments, seen.now)}.",
            "Its own TV search, another program, a hand or the wind may move it.",
            (
                f"Keep clear of it. If it still moves, press Space in the app, or use its {seen.switch}.",
                "Switch its TV search off (F8, or `birdcage init`), and end other programs that use its port.",
                "If wind moves it, its motors may be released or its base loose.",
            ),
            moments[0], moments[-1], len(faults),
        )  # fmt: skip


def stuck_speed(seen: Examination) -> Iterator[Finding]:
    """A dish that did not take its own speed back after a pass."""
    faults = seen.of_reason(FaultReason.SPEED)
    if faults:
        moments = [each.utc for each in faults]
        yield Finding(
            "speed", Urgency.NOTE, f"The dish did not restore its speed {how_often(moments, seen.now)}.",
            "It moves slower than planned until it is switched off and on.",
            (f"Switch it off and on at its {seen.switch}, then home it.",), moments[0], moments[-1], len(faults),
        )  # fmt: skip
