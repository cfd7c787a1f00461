"""What the dish's own settings say: what moves it by itself, what changed, what counts only later."""

from __future__ import annotations

from collections.abc import Iterator

from birdcage.base.journal import JOURNAL
from birdcage.base.journal_rows import IncidentKind
from birdcage.diagnostics.examination import Examination
from birdcage.diagnostics.finding import Finding, Urgency
from birdcage.diagnostics.wording import listed, on
from birdcage.rotator.facts import SearchSwitch
from birdcage.rotator.feature import LNB_SUPPLY, POLARISATION, SLEEP_TIMER, TV_SEARCH, Range
from birdcage.station.state import TvSearch
from birdcage.station.wear import WEAR

SUPPLY_V = Range(11.0, 21.0)
"""What an LNB is fed with, 13 or 18 V about (`docs/safety.md`, *The coax carries a voltage*)."""
VERTICAL_V, HORIZONTAL_V = Range(11.0, 15.0), Range(16.0, 21.0)
ASKS_FOR = {"V": (VERTICAL_V, "vertical", "13 V"), "H": (HORIZONTAL_V, "horizontal", "18 V")}
"""The supply by which a receiver asks an LNB for either polarisation."""
SEE_TO_IT = "`birdcage paths` shows where the journal is. Check its permissions and the room on the disk."
KEEP_CLEAR = "Keep clear whenever it gets power."


def not_homed(seen: Examination) -> Iterator[Finding]:
    """A dish that does not know where it points."""
    if seen.answers and seen.state.homed is False:
        yield Finding(
            "homed", Urgency.STOPS,
            "The dish is not synced: it does not know where it points." if seen.state.awaits_sync
            else "The dish is not homed: it does not know where it points.",
            "Nothing can be pointed until it does.", (seen.home_it,), lasts=True,
        )  # fmt: skip


def tv_search(seen: Examination) -> Iterator[Finding]:
    """The firmware's own search, by which a dish moves unasked."""
    if seen.facts is None:
        return
    switch, search, saved = seen.facts.search_switch, seen.state.search, seen.reading(TV_SEARCH)
    if search is TvSearch.RUNNING:
        yield Finding(
            "search", Urgency.HURTS, "The TV search runs: the dish moves by itself.",
            "It goes through the sky until it has found a TV satellite, or given up.",
            ("Keep clear. End the search: F8, or `birdcage init`.",), lasts=True,
        )  # fmt: skip
    elif switch is SearchSwitch.UNTIL_POWER_UP:
        yield Finding(
            "search", Urgency.NOTE, "At each power-up this dish searches for TV satellites, and moves by itself.",
            "No setting ends that for good.", (f"{KEEP_CLEAR} `birdcage init` ends the search.",),
        )  # fmt: skip
    elif switch is SearchSwitch.FOR_GOOD and saved is not None and saved.value is not False:
        yield Finding(
            "search", Urgency.HURTS, "The TV search is on: at each power-up the dish moves by itself.",
            "It homes, and then goes through the sky for minutes.",
            (f"{KEEP_CLEAR} Switch the search off: F8, or `birdcage init`.",), lasts=True,
        )  # fmt: skip
    elif switch is SearchSwitch.FOR_GOOD and seen.answers and search is TvSearch.UNKNOWN and saved is None:
        if seen.state.surveyed:
            yield Finding(
                "search", Urgency.WILL_STOP, "Whether the TV search is on is unknown: the dish may move by itself.",
                "It did not tell that setting.", (f"{KEEP_CLEAR} Check it: `birdcage get {TV_SEARCH}`.",),
            )  # fmt: skip
    elif switch is SearchSwitch.NOT_KNOWN:
        yield Finding(
            "search", Urgency.NOTE, "This dish may search for TV satellites by itself after power-up.",
            "No source tells how to end that.", (f"{KEEP_CLEAR}",),
        )  # fmt: skip


def sleep_timer(seen: Examination) -> Iterator[Finding]:
    """A timer after which the dish sleeps."""
    reading = seen.reading(SLEEP_TIMER)
    if reading is not None and isinstance(reading.value, float) and reading.value > 0 and seen.facts is not None:
        label = seen.facts.features[SLEEP_TIMER].label if SLEEP_TIMER in seen.facts.features else "Sleep timer"
        yield Finding(
            "sleep", Urgency.NOTE, f"{label}: {reading.value:g} s. What sleep does is unknown.",
            "A pause longer than that may end a map, or lose the first line after it.",
            ("Nothing has to be done. If the dish stops answering after a pause, this may be why.",),
            grade=float(reading.value),
        )  # fmt: skip


def pending(seen: Examination) -> Iterator[Finding]:
    """Settings that were saved, and are not in force before the dish starts anew; those that were not even saved."""
    started = [each.utc for each in seen.history.recent_incidents(IncidentKind.RESTART, IncidentKind.START)]
    saved = [
        each for each in seen.history.recent_incidents(IncidentKind.SAVED)
        if not started or each.utc > started[-1]
    ]  # fmt: skip
    if saved:
        names = dict.fromkeys(name for each in saved for name in each.sentence.split(", ") if name)
        yield Finding(
            "pending", Urgency.NOTE,
            f"Saved in the dish {on(saved[-1].utc, seen.now)}, and not in force before its next power-up: "
            f"{listed(list(names) or ['its settings'])}.",
            "The dish goes by what is saved only from its next start on, and no start was heard since.",
            (
                f"Switch it off and on at its {seen.switch} when nothing is under way.",
                seen.home_it,
                "If you did that while no birdcage program was running, acknowledge this.",
            ),
            saved[0].utc, saved[-1].utc, len(saved),
        )  # fmt: skip
    if seen.unsaved:
        yield Finding(
            "unsaved", Urgency.NOTE, f"Changed in the dish, and not saved: {listed(seen.unsaved)}.",
            "A power cycle takes these changes back.",
            ("To keep them: `birdcage nvs save`. To drop them: switch the dish off and on.",), count=len(seen.unsaved),
            lasts=True,
        )  # fmt: skip


def changed_limits(seen: Examination) -> Iterator[Finding]:
    """Limits that differ from what held before the days that are judged, or from the first that was told."""
    told = [each for each in seen.history.settings if each.name != TV_SEARCH]
    for name in dict.fromkeys(each.name for each in told):
        mine = [each for each in told if each.name == name]
        known = [each for each in mine if each.utc < seen.history.begin] or mine[:1]
        was, now = _degrees(known[-1].value), _degrees(mine[-1].value)
        if was == now:
            continue
        feature = seen.facts.features.get(name) if seen.facts is not None else None
        label = name if feature is None else feature.label
        yield Finding(
            f"limit.{name}", Urgency.WILL_STOP,
            f"{label} changed {on(mine[-1].utc, seen.now)}: {was} before, {now} now.",
            "The dish's own limits keep it from running into its base and its stops. birdcage moves it by them.",
            (
                "If you changed it, acknowledge this.",
                f"If not, set it back to {was}, or narrow it in birdcage.toml, section `motion`.",
            ),
            mine[-1].utc, mine[-1].utc,
        )  # fmt: skip


def _degrees(value: str) -> str:
    try:
        return f"{float(value):.2f}°"
    except ValueError:
        return value


def lnb(seen: Examination) -> Iterator[Finding]:
    """A supply of the LNB that is none, or asks for the other polarisation."""
    reading = seen.reading(LNB_SUPPLY)
    if reading is None or not isinstance(reading.value, float):
        return
    volts, polarisation = reading.value, seen.reading(POLARISATION)
    wanted = None if polarisation is None else ASKS_FOR.get(str(polarisation.value).upper()[:1])
    if not SUPPLY_V.holds(volts):
        yield Finding(
            "lnb", Urgency.WILL_STOP, f"The LNB's supply is {volts:.1f} V. It should be 13 or 18 V, about.",
            "Too little: the coax is shorted, or the supply is off. The receiver hears nothing then."
            if volts < SUPPLY_V.low else "Too much may damage the LNB.",
            (
                f"Switch the dish off at its {seen.switch}. Check the coax and its plugs for a short.",
                "Anything else on that coax that takes current (DC block missing, splitter, SDR) may be the cause.",
            ),
            lasts=True,
        )  # fmt: skip
    elif wanted is not None and not wanted[0].holds(volts):
        _range, word, usual = wanted
        yield Finding(
            "lnb", Urgency.NOTE, f"The LNB's supply is {volts:.1f} V, but the receiver is tuned to a {word} channel.",
            f"A {word} channel needs {usual}, about: with another supply the LNB passes the other polarisation.",
            ("Tune to a transponder again (n on F3), or read the level of both polarisations (b on F3).",),
            lasts=True,
        )  # fmt: skip


def journal(seen: Examination) -> Iterator[Finding]:
    """A history that can't be read, or is not kept."""
    if seen.history.problem:
        yield Finding(
            "journal", Urgency.WILL_STOP, "The dish's history is not available, so this is only its present state.",
            seen.history.problem, (SEE_TO_IT,), lasts=True,
        )  # fmt: skip
    elif lost := seen.state.warnings.get(JOURNAL) or seen.state.warnings.get(WEAR):
        yield Finding(
            "journal", Urgency.WILL_STOP, "What happens to the dish now is not being kept.", lost, (SEE_TO_IT,),
            lasts=True,
        )  # fmt: skip
