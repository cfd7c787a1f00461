"""What restarts and silences say of the supply, the link and the dish's console."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta

from birdcage.base.journal_rows import DishIncident, IncidentKind
from birdcage.base.reason import Reason
from birdcage.diagnostics.examination import Examination
from birdcage.diagnostics.finding import Finding, Urgency
from birdcage.diagnostics.wording import how_often, many
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.state import FaultReason, LinkPhase, TvSearch

SWITCHED_OFF = timedelta(seconds=30)
"""A dish that was silent for longer before its boot text was without power: somebody's switch, or a cut."""
SHORT_GAP = timedelta(minutes=10)
"""A silence that ends within this, with no restart, is of the link and not of somebody's switch."""
PORT_GONE = "The port of the dish is gone.", "Plug the adapter in. `birdcage ports` lists what is there."
PORT_REFUSED = {
    Reason.BUSY: ("Another program has the port of the dish.", "End that program."),
    Reason.PERMISSION: ("You may not open the port of the dish.", "F8 or `birdcage setup` says how to be allowed."),
}
"""What is wrong with a port, and what to do."""
FEW = 3
"""So many restarts or losses are no accident any more."""


BESIDE = timedelta(minutes=1)
"""A dish that no longer knows where it points within this of a boot text has restarted once, and not twice."""
ENDS = (IncidentKind.RESTART, IncidentKind.BACK)
"""What ends an outage."""


@dataclass(frozen=True, slots=True)
class Outage:
    """From the moment when the dish was out of reach until it was heard again."""

    began: DishIncident
    ended: DishIncident | None
    """How: a restart, or an answer; None where that is not known."""

    @property
    def restarted(self) -> bool:
        """Whether it came back by a restart."""
        return self.ended is not None and self.ended.kind is IncidentKind.RESTART

    @property
    def lasted(self) -> timedelta | None:
        """How long it was; None where that is not known."""
        return None if self.ended is None else self.ended.utc - self.began.utc


def outages(seen: Examination) -> list[Outage]:
    """Return the outages that began in the days that are judged, oldest first."""
    return [each for each in _all_outages(seen) if each.began.utc >= seen.history.begin]


def _all_outages(seen: Examination) -> list[Outage]:
    """Return all outages, oldest first.

    A START is heard by a program that had not met the dish: the one that saw the outage has ended, and when the dish
    came back is not known. Such an outage is left out.
    """
    found: list[Outage] = []
    for each in seen.history.incidents:
        is_open = bool(found) and found[-1].ended is None
        if each.kind in (IncidentKind.SILENT, IncidentKind.LOST):
            found.append(Outage(each, None))
        elif is_open and each.kind in ENDS:
            found[-1] = Outage(found[-1].began, each)
        elif is_open and each.kind is IncidentKind.START:
            found.pop()
    return found


def all_restarts(seen: Examination) -> list[DishIncident]:
    """Return the restarts of the days that are judged, whoever caused them, oldest first.

    A dish that no longer knows where it points has restarted, too, though its boot text was not heard.
    """
    heard = seen.history.recent_incidents(IncidentKind.RESTART, IncidentKind.START)
    forgot = [
        DishIncident(each.utc, each.dish, IncidentKind.RESTART, sentence=each.sentence)
        for each in seen.of_reason(FaultReason.UNHOMED) if all(abs(each.utc - other.utc) > BESIDE for other in heard)
    ]  # fmt: skip
    return sorted([*heard, *forgot], key=lambda each: each.utc)


def restarts(seen: Examination) -> Iterator[Finding]:
    """Restarts by themselves. While the dish moves they speak for a supply that sags under the motors."""
    switched = {
        id(each.ended) for each in _all_outages(seen)
        if each.restarted and each.lasted is not None and each.lasted > SWITCHED_OFF
    }  # fmt: skip
    every = all_restarts(seen)
    by_itself = [each for each in every if each.kind is IncidentKind.RESTART and id(each) not in switched]
    if not by_itself:
        return
    moments = [each.utc for each in by_itself]
    count, moving = len(by_itself), sum(each.moving for each in by_itself)
    what = f"The dish restarted {how_often(moments, seen.now)}"
    meaning = f"{_not_counted(len(every) - count)} {_after_a_restart(seen)}".strip()
    if moving > 1 and 2 * moving >= count:
        supply = "" if seen.facts is None else seen.facts.handling.supply
        yield Finding(
            "restarts", Urgency.STOPS,
            f"{what}, {_of(moving, count)} while it moved. Its supply is probably too weak.",
            f"Motors draw the most when they start: the voltage dips, and the dish restarts. {meaning}".strip(),
            (
                f"Measure the voltage at the dish while both axes move. It must not dip. {supply}".strip(),
                "Use a shorter or thicker cable, and a supply that gives more current. Check every plug on the way.",
                seen.home_it,
            ),
            moments[0], moments[-1], count,
        )  # fmt: skip
        return
    yield Finding(
        "restarts", Urgency.WILL_STOP if count >= FEW else Urgency.NOTE, f"{what}.",
        f"{many(moving, 'restart')} came while it moved. {meaning}".strip()
        if moving else f"It was at rest. {meaning}".strip(),
        (
            "Did somebody switch it off and on? If not, look for a loose contact: power plug, switch, supply.",
            seen.home_it,
        ),
        moments[0], moments[-1], count,
    )  # fmt: skip


def _not_counted(others: int) -> str:
    """Say how many more restarts the figures have, so that both agree."""
    return f"Not counted here: {others:,} that {'look' if others > 1 else 'looks'} like its switch." if others else ""


def _after_a_restart(seen: Examination) -> str:
    facts, words = seen.facts, []
    if facts is None or not facts.never_homes:
        words.append("After a restart it does not know where it points until it has homed.")
    is_off = seen.answers and seen.state.search in (TvSearch.OFF, TvSearch.NONE)
    if not is_off and (facts is None or facts.search_switch is not SearchSwitch.NEVER_SEARCHES):
        words.append("It may start its TV search, too, and move by itself.")
    return " ".join(words)


def _of(part: int, count: int) -> str:
    return {2: "both times"}.get(count, "each time") if part == count else f"{part} of them"


def deadlocks(seen: Examination) -> Iterator[Finding]:
    """Silences in mid-move that only a restart has ended."""
    found = [
        each for each in outages(seen)
        if each.began.kind is IncidentKind.SILENT and each.began.moving and each.restarted
        and each.lasted is not None and each.lasted > SWITCHED_OFF
    ]  # fmt: skip
    if found:
        moments = [each.began.utc for each in found]
        yield Finding(
            "deadlock", Urgency.STOPS if seen.is_recent(moments[-1]) else Urgency.WILL_STOP,
            f"The dish fell silent in mid-move {how_often(moments, seen.now)}. Only a restart brought it back.",
            "Its console may have deadlocked: no command, and so no STOP, reaches it then. Or its power failed.",
            (
                f"Keep the {seen.switch} in reach while it moves: nothing else ends a deadlock.",
                "When it is silent again: off for ten seconds, then on.",
                seen.home_it,
                "Was a line typed on F5 just before? Leave that command out.",
            ),
            moments[0], moments[-1], len(found),
        )  # fmt: skip


def silent_now(seen: Examination) -> Iterator[Finding]:
    """A dish or a port that is out of reach at this moment."""
    link = seen.state.link
    if link.state is LinkPhase.SILENT:
        yield Finding(
            "silent", Urgency.STOPS, "The dish does not answer.", link.detail or "Its port is there.",
            (
                "Has it power? Look at its lamp or its motor. Then check the plug at the dish and at the adapter.",
                f"If it has power: off at its {seen.switch}, wait ten seconds, and on.",
                seen.home_it,
                "If it never answered here: F8 or `birdcage setup` finds the cause.",
            ),
            lasts=True,
        )  # fmt: skip
    elif link.state is LinkPhase.LOST and seen.state.port:
        text, todo = PORT_REFUSED.get(link.reason, PORT_GONE) if link.reason is not None else PORT_GONE
        yield Finding("port", Urgency.STOPS, text, link.detail, (todo,), lasts=True)


def losses(seen: Examination) -> Iterator[Finding]:
    """An adapter that disappears, and a dish that is out of hearing for moments."""
    lost = seen.history.recent_incidents(IncidentKind.LOST)
    if len(lost) >= FEW:
        moments = [each.utc for each in lost]
        yield Finding(
            "port_lost", _pressing(seen, moments), f"The port of the dish went away {how_often(moments, seen.now)}.",
            "The computer lost its adapter: a loose plug, a long or poor USB cable, or a hub without enough power. "
            "While it is gone, STOP can't be sent.",
            (
                "Plug the adapter into the computer itself, with a short cable.",
                "If it goes on, try another adapter: `birdcage wiring adapters` lists those that work.",
            ),
            moments[0], moments[-1], len(lost),
        )  # fmt: skip
    short = [
        each for each in outages(seen)
        if each.began.kind is IncidentKind.SILENT and not each.restarted
        and each.lasted is not None and each.lasted <= SHORT_GAP
    ]  # fmt: skip
    if len(short) >= FEW:
        moments = [each.began.utc for each in short]
        moving = sum(each.began.moving for each in short)
        yield Finding(
            "gaps", _pressing(seen, moments),
            f"The dish was out of hearing {how_often(moments, seen.now)}, and came back by itself.",
            f"{many(moving, 'time')} it was moving. A contact that opens for moments does that."
            if moving else "A contact that opens for moments does that.",
            (
                "Move the plugs at the dish and at the adapter while you watch F5: where it breaks, clean or replace.",
                "Does it happen at one azimuth? Then a wire breaks inside the cable where it bends.",
            ),
            moments[0], moments[-1], len(short),
        )  # fmt: skip


def _pressing(seen: Examination, moments: list[datetime]) -> Urgency:
    day = [each for each in moments if each > seen.now - timedelta(days=1)]
    return Urgency.STOPS if len(day) >= FEW else Urgency.WILL_STOP
